//! Messages of a desktop to a window, which no mouse can send where no window manager runs.

use super::desktop::Desktop;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{Atom, ClientMessageEvent, ConnectionExt, EventMask};

/// Asks the window to close, as the button in its title bar does.
pub(super) fn close(desktop: &Desktop) {
    let window: u32 = desktop.window().expect("there is a window").parse().expect("the number of a window");
    let (connection, _) = x11rb::connect(Some(&desktop.display)).expect("the display answers");
    let atom = |name: &str| -> Atom {
        connection.intern_atom(false, name.as_bytes()).expect("a request").reply().expect("an answer").atom
    };
    let data = [atom("WM_DELETE_WINDOW"), x11rb::CURRENT_TIME, 0, 0, 0];
    let message = ClientMessageEvent::new(32, window, atom("WM_PROTOCOLS"), data);
    connection.send_event(false, window, EventMask::NO_EVENT, message).expect("a request").check().expect("an answer");
    connection.flush().expect("the display takes requests");
}
