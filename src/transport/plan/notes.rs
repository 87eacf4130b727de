//! What is said of a plan's decisions.

use super::surfaces::shows;
use crate::math::Rgb;
use crate::transport::light_choice::CHOSEN;
use crate::world::World;

/// One decision, for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlanNote {
    /// A component of light or of work.
    pub what: String,
    /// Whether it is rendered; otherwise it is skipped.
    pub rendered: bool,
    /// Why.
    pub reason: String,
}

/// Every decision, as they are made.
#[derive(Default)]
pub(super) struct Notes(pub(super) Vec<PlanNote>);

impl Notes {
    pub(super) fn render(&mut self, what: &str, reason: String) {
        self.0.push(PlanNote { what: what.to_owned(), rendered: true, reason });
    }

    pub(super) fn skip(&mut self, what: &str, reason: &str) {
        self.0.push(PlanNote { what: what.to_owned(), rendered: false, reason: reason.to_owned() });
    }

    /// Whether there is light to transport.
    pub(super) fn lights(&mut self, world: &World) -> bool {
        const WHAT: &str = "direct light and photons";
        if world.lights.is_empty() {
            self.skip(WHAT, "there is no light that has any power");
        } else if world.max_bounces == 0 {
            self.skip(WHAT, "max_bounces is 0: only lights are seen");
        } else if !shows(world, |_, _| true) {
            self.skip(WHAT, "there is no surface to light");
        } else if !shows(world, |world, p| world.scattered_bound(p) > 0.0) {
            self.skip(WHAT, "no surface scatters light in many directions");
        } else {
            let reason = match world.lights.len() {
                1 => "1 light, one shadow ray for each point".to_owned(),
                few if few <= CHOSEN => format!("{few} lights, one shadow ray each"),
                many => format!("{many} lights; each point asks {CHOSEN}, chosen by their share of its light"),
            };
            self.render("direct light", reason);
            return true;
        }
        false
    }

    pub(super) fn textures(&mut self, world: &World) {
        match world.materials.iter().filter(|m| m.lookups() > 0).count() {
            0 => self.skip("textures", "no visible material has one: surface parameters are never computed"),
            1 => self.render("textures", "1 material reads them".to_owned()),
            textured => self.render("textures", format!("{textured} materials read them")),
        }
    }

    pub(super) fn background(&mut self, world: &World) {
        if world.background != Rgb::ZERO {
            self.render(
                "background",
                "the camera sees it, also in mirrors, glass and gloss; it sends no light to diffuse surfaces"
                    .to_owned(),
            );
        }
    }
}
