//! Anything that a hand can do: the window neither panics nor hangs, and it gives the memory back.

use super::desktop::SCREEN;
use super::file_dialogs::{self, Answer};
use super::session::{self, Session};
use super::wait_for;
use std::time::{Duration, Instant};

/// Actions of one call of xdotool.
const BATCH: usize = 20;
/// The longest time until the window reacts after the last input.
const REACTION: Duration = Duration::from_secs(30);

/// A reproducible sequence of numbers (SplitMix64).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) % end as u64) as usize
    }

    fn of(&mut self, choices: &[&'static str]) -> &'static str {
        choices[self.below(choices.len())]
    }
}

/// Keys of the window's shortcuts and of text fields.
const KEYS: [&str; 52] = [
    "a",
    "b",
    "c",
    "e",
    "f",
    "g",
    "h",
    "i",
    "j",
    "k",
    "l",
    "m",
    "n",
    "o",
    "p",
    "r",
    "s",
    "t",
    "u",
    "v",
    "w",
    "x",
    "y",
    "z",
    "0",
    "1",
    "2",
    "3",
    "7",
    "9",
    "period",
    "minus",
    "plus",
    "space",
    "Return",
    "Tab",
    "Escape",
    "Escape",
    "Escape",
    "BackSpace",
    "Delete",
    "Left",
    "Right",
    "Up",
    "Down",
    "Home",
    "End",
    "Prior",
    "Next",
    "F1",
    "F2",
    "F11",
];
const MODIFIERS: [&str; 8] = ["", "", "", "shift+", "ctrl+", "ctrl+", "ctrl+shift+", "alt+"];
const HELD: [&str; 8] = ["", "", "", "shift", "ctrl", "alt", "x", "z"];

/// One action at random: mostly the pointer, on the picture more often than elsewhere.
fn action(random: &mut Random, at: &mut (i32, i32)) -> Vec<String> {
    let words = |text: String| text.split_whitespace().map(str::to_owned).collect();
    let button = random.of(&["1", "1", "1", "2", "3"]);
    let held = random.of(&HELD);
    match random.below(10) {
        0..=2 => words(movement(random, at)),
        3 => words(format!("click {button}")),
        4 | 5 => {
            let drag = (0..5).map(|_| movement(random, at)).collect::<Vec<_>>().join(" sleep 0.01 ");
            let (down, up) = if held.is_empty() {
                (String::new(), String::new())
            } else {
                (format!("keydown {held}"), format!("keyup {held}"))
            };
            words(format!("{down} mousedown {button} {drag} mouseup {button} {up}"))
        }
        6 => words(format!("click --repeat {} --delay 5 {}", 1 + random.below(9), random.of(&["4", "5"]))),
        _ => words(format!("key {}{}", random.of(&MODIFIERS), random.of(&KEYS))),
    }
}

fn movement(random: &mut Random, at: &mut (i32, i32)) -> String {
    let step = |random: &mut Random| random.below(61) as i32 - 30;
    let far = random.below(4) == 0;
    let next = if far {
        (random.below(SCREEN.0 as usize) as i32, random.below(SCREEN.1 as usize) as i32)
    } else {
        (at.0 + step(random), at.1 + step(random))
    };
    *at = (next.0.clamp(0, SCREEN.0 as i32 - 1), next.1.clamp(0, SCREEN.1 as i32 - 1));
    format!("mousemove {} {}", at.0, at.1)
}

/// Resident memory of the program, MB.
fn memory(session: &Session) -> f64 {
    let path = format!("/proc/{}/statm", session.program.0.id());
    let pages = std::fs::read_to_string(path).expect("the program runs");
    let resident: f64 =
        pages.split_whitespace().nth(1).and_then(|field| field.parse().ok()).expect("a number of pages");
    resident * 4096.0 / 1e6
}

/// Brings the picture back to the size of the start, and the rendering out of a pause: a larger picture takes more memory.
fn show_as_at_the_start(session: &Session) {
    let mut toggles = ["w", "space"].into_iter().cycle();
    wait_for("picture of the start", || {
        session.key("ctrl+1");
        std::thread::sleep(Duration::from_secs(1));
        let found = session.film_corner();
        if found.is_none() {
            toggles.next().into_iter().for_each(|key| session.key(key));
        }
        found
    });
}

/// Opens the scene of the start again, whatever the window shows, edits it and saves it; returns the time until the file shows the edit.
fn reaction(session: &Session) -> Duration {
    let (start, desktop) = (Instant::now(), &session.desktop);
    let [fresh, other] = ["fresh.toml", "other.toml"].map(|name| session.folder.path().join(name));
    std::fs::write(&fresh, session::scene_text()).expect("the scene is written");
    file_dialogs::set(desktop, &Answer::Paths(&fresh, &other));
    let escape = || (0..4).for_each(|_| desktop.key_in_window("Escape"));
    wait_for("scene of the start", || {
        escape();
        desktop.key("ctrl+o");
        std::thread::sleep(Duration::from_secs(1));
        // Where there are unsaved changes, the window asks to save them first.
        desktop.key("Return");
        desktop.has_title("^fresh.toml").then_some(())
    });
    escape();
    wait_for("saved edit", || {
        desktop.key("e");
        desktop.key("ctrl+s");
        (session::open(&fresh).film.exposure > 0.0).then_some(())
    });
    start.elapsed()
}

fn number(variable: &str, default: u64) -> u64 {
    std::env::var(variable).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

#[test]
fn random_input_neither_ends_the_window_nor_keeps_memory() {
    let seconds = number("PATCHLIGHT_RANDOM_SECONDS", 10);
    let seed = number("PATCHLIGHT_RANDOM_SEED", 1);
    let mut session = Session::start_on(file_dialogs::desktop_with(&Answer::Cancel));
    let (mut random, mut at) = (Random(seed), (640, 400));
    std::thread::sleep(Duration::from_secs(2));
    let before = memory(&session);
    let (start, mut actions, mut restarts) = (Instant::now(), 0, 0);
    while start.elapsed() < Duration::from_secs(seconds) {
        let batch: Vec<String> = (0..BATCH)
            .flat_map(|_| action(&mut random, &mut at).into_iter().chain(["sleep".to_owned(), "0.01".to_owned()]))
            .collect();
        session.desktop.xdotool(&batch.iter().map(String::as_str).collect::<Vec<_>>());
        actions += BATCH;
        if let Some(status) = session.program.0.try_wait().expect("the state of a child is known") {
            // A menu or the list of commands can close the window.
            let errors = session.desktop.errors();
            assert!(status.success(), "seed {seed}: {status} after {actions} actions: {errors}");
            session.program = session.desktop.open(&session.scene);
            restarts += 1;
        }
    }
    let reaction = reaction(&session);
    show_as_at_the_start(&session);
    std::thread::sleep(Duration::from_secs(3));
    let after = memory(&session);
    eprintln!(
        "seed {seed}: {actions} actions in {seconds} s, {restarts} restarts; {before:.0} MB before, {after:.0} MB after; \
         reaction after {reaction:?}"
    );
    assert!(session.program.is_alive(), "seed {seed}: the program runs");
    assert!(reaction < REACTION, "seed {seed}: it reacts after {reaction:?}");
    assert!(after < 2.0 * before + 100.0, "seed {seed}: {before} MB before, {after} MB after");
}
