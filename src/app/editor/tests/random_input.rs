//! Random input: nothing that a hand can do makes the window panic, and every edit can be undone.

use super::*;

/// Inputs of one run.
const INPUTS: usize = 1500;

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

    fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }
}

const MODIFIERS: [Modifiers; 5] =
    [Modifiers::NONE, Modifiers::NONE, Modifiers::SHIFT, Modifiers::COMMAND, Modifiers::ALT];
const TEXTS: [&str; 8] = ["0.1", "-3", "nan", "1e300", "*2", "ä", "ball", "/0"];

/// One input at random: mostly the pointer, on the picture more often than elsewhere.
fn input(ui: &mut Ui, random: &mut Random, at: &mut Pos2) {
    let modifiers = random.of(&MODIFIERS);
    let button =
        random.of(&[egui::PointerButton::Primary, egui::PointerButton::Primary, egui::PointerButton::Secondary]);
    match random.below(10) {
        0..=3 => {
            let far = random.below(3) == 0;
            let step = |random: &mut Random| random.below(41) as f32 - 20.0;
            *at = if far {
                Pos2::new(random.below(1280) as f32, random.below(900) as f32)
            } else {
                *at + vec2(step(random), step(random))
            };
            ui.event(Event::PointerMoved(*at));
        }
        4 | 5 => {
            for pressed in [true, false] {
                ui.event(Event::PointerButton { pos: *at, button, pressed, modifiers });
            }
        }
        // The button stays down for the next movements.
        6 => ui.event(Event::PointerButton { pos: *at, button, pressed: random.below(2) == 0, modifiers }),
        7 => ui.event(Event::MouseWheel {
            unit: MouseWheelUnit::Line,
            delta: vec2(0.0, random.below(21) as f32 - 10.0),
            phase: TouchPhase::Move,
            source: MouseWheelSource::Unknown,
            modifiers,
        }),
        8 => ui.event(Event::Text(random.of(&TEXTS).to_owned())),
        _ => {
            let key = random.of(Key::ALL);
            ui.key_press_modifiers(modifiers, key);
        }
    }
}

#[test]
fn random_input_neither_panics_nor_loses_an_undo_step() {
    for (seed, example) in [(1, "report"), (2, "teapot"), (3, "lens")] {
        let mut ui = open(example);
        answer_dialogs(&mut ui, None);
        let (mut random, mut at) = (Random(seed), Pos2::new(600.0, 400.0));
        for k in 0..INPUTS {
            input(&mut ui, &mut random, &mut at);
            ui.run_steps(1);
            // A typed path could name a file of the user.
            if matches!(ui.state().dialog, Some(Dialog::Path(..))) {
                ui.key_press(Key::Escape);
                ui.run_steps(1);
            }
            if k % 50 == 0 {
                receive(&mut ui, frame(1, k % 100 == 0, 16));
            }
        }
        let mut steps = 0;
        while ui.state().document.undoable().is_some() {
            ui.state_mut().document.undo();
            steps += 1;
            assert!(steps < INPUTS, "undo ends");
        }
        let problems = crate::scene::validate(scene(&ui));
        assert!(problems.is_empty(), "the first state is valid: {problems:?}");
        ui.run_steps(2);
    }
}
