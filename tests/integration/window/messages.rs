//! Messages of a desktop to a window, which no mouse can send where no window manager and no file manager run.

use super::desktop::Desktop;
use super::wait_for;
use std::path::Path;
use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    Atom, ClientMessageEvent, ConnectionExt, CreateWindowAux, EventMask, PropMode, SELECTION_NOTIFY_EVENT,
    SelectionNotifyEvent, SelectionRequestEvent, Window, WindowClass,
};
use x11rb::rust_connection::RustConnection;
use x11rb::wrapper::ConnectionExt as _;

/// The version of the protocol of drag and drop, in the place where its first message has it.
const DRAG_VERSION: u32 = 5 << 24;

/// Asks the window to close, as the button in its title bar does.
pub(super) fn close(desktop: &Desktop) {
    let sender = Sender::new(desktop);
    sender.send("WM_PROTOCOLS", [sender.atom("WM_DELETE_WINDOW"), x11rb::CURRENT_TIME, 0, 0, 0]);
}

/// Drags files from a file manager over the window; calls `over` while they are there, and drops them.
pub(super) fn drop_files(desktop: &Desktop, files: &[&Path], over: impl FnOnce()) {
    let sender = Sender::new(desktop);
    let list = files.iter().map(|file| format!("file://{}\r\n", escaped(file))).collect::<String>();
    let source = sender.own_window();
    let selection = sender.atom("XdndSelection");
    let owned = sender.connection.set_selection_owner(source, selection, x11rb::CURRENT_TIME);
    owned.expect("a request").check().expect("an answer");
    sender.send("XdndEnter", [source, DRAG_VERSION, sender.atom("text/uri-list"), 0, 0]);
    sender.send("XdndPosition", [source, 0, (640 << 16) | 400, x11rb::CURRENT_TIME, sender.atom("XdndActionCopy")]);
    sender.serve(&list);
    over();
    sender.send("XdndDrop", [source, 0, x11rb::CURRENT_TIME, 0, 0]);
    sender.wait_for_message("XdndFinished");
}

/// The path as in a URI: every byte but letters, digits and a few signs in hexadecimal.
fn escaped(path: &Path) -> String {
    let bytes = path.to_str().expect("a path in UTF-8").bytes();
    let escape = |byte: u8| match byte {
        b'/' | b'.' | b'-' | b'_' => char::from(byte).to_string(),
        byte if byte.is_ascii_alphanumeric() => char::from(byte).to_string(),
        byte => format!("%{byte:02X}"),
    };
    bytes.map(escape).collect()
}

/// A program that sends messages to the window.
struct Sender {
    connection: RustConnection,
    root: Window,
    window: Window,
}

impl Sender {
    fn new(desktop: &Desktop) -> Self {
        let window = desktop.window().expect("there is a window").parse().expect("the number of a window");
        let (connection, screen) = RustConnection::connect(Some(&desktop.display)).expect("the display answers");
        let root = connection.setup().roots[screen].root;
        Self { connection, root, window }
    }

    fn atom(&self, name: &str) -> Atom {
        let answer = self.connection.intern_atom(false, name.as_bytes()).expect("a request").reply();
        answer.expect("an answer").atom
    }

    fn send(&self, kind: &str, data: [u32; 5]) {
        let message = ClientMessageEvent::new(32, self.window, self.atom(kind), data);
        let sent = self.connection.send_event(false, self.window, EventMask::NO_EVENT, message);
        sent.expect("a request").check().expect("an answer");
    }

    /// A window that nobody sees.
    fn own_window(&self) -> Window {
        let window = self.connection.generate_id().expect("a free number");
        let (kind, settings) = (WindowClass::INPUT_ONLY, CreateWindowAux::new());
        let created = self.connection.create_window(0, window, self.root, 0, 0, 1, 1, 0, kind, 0, &settings);
        created.expect("a request").check().expect("an answer");
        window
    }

    /// Waits for the window's request for the list of files, and answers it.
    fn serve(&self, list: &str) {
        let request = wait_for("request for the files", || match self.connection.poll_for_event() {
            Ok(Some(Event::SelectionRequest(request))) => Some(request),
            _ => None,
        });
        let SelectionRequestEvent { requestor, selection, target, property, time, .. } = request;
        assert_eq!(target, self.atom("text/uri-list"), "it asks for the list");
        let written = self.connection.change_property8(PropMode::REPLACE, requestor, property, target, list.as_bytes());
        written.expect("a request").check().expect("an answer");
        let answer = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time,
            requestor,
            selection,
            target,
            property,
        };
        let sent = self.connection.send_event(false, requestor, EventMask::NO_EVENT, answer);
        sent.expect("a request").check().expect("an answer");
    }

    fn wait_for_message(&self, kind: &str) {
        let kind = self.atom(kind);
        wait_for("message of the window", || match self.connection.poll_for_event() {
            Ok(Some(Event::ClientMessage(message))) if message.type_ == kind => Some(()),
            _ => None,
        });
    }
}
