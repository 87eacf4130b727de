//! The views that the user visited, to go back and forward through.

use crate::scene::Camera;

/// The views before and after the present one.
#[derive(Debug)]
pub(crate) struct Visited {
    before: Vec<Camera>,
    after: Vec<Camera>,
    /// The camera when it rested last.
    rest: Camera,
}

impl Visited {
    /// No view but this one.
    pub(crate) fn new(camera: Camera) -> Self {
        Self { before: Vec::new(), after: Vec::new(), rest: camera }
    }

    /// Notes that the camera rests here: a new place becomes the present view, and the last one the previous view.
    pub(crate) fn rest(&mut self, camera: Camera) {
        if camera != self.rest {
            self.before.push(std::mem::replace(&mut self.rest, camera));
            self.after.clear();
        }
    }

    /// The camera when it rested last.
    pub(crate) fn present(&self) -> Camera {
        self.rest
    }

    /// Goes back to the previous view; `None` before the first.
    pub(crate) fn back(&mut self) -> Option<Camera> {
        let camera = self.before.pop()?;
        self.after.push(std::mem::replace(&mut self.rest, camera));
        Some(camera)
    }

    /// Goes forward to the next view; `None` after the last.
    pub(crate) fn forward(&mut self) -> Option<Camera> {
        let camera = self.after.pop()?;
        self.before.push(std::mem::replace(&mut self.rest, camera));
        Some(camera)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn back_and_forward_go_through_the_places_of_rest() {
        let at = |x: f64| Camera { target: x * DVec3::X, ..Camera::default() };
        let mut visited = Visited::new(at(0.0));
        for x in [1.0, 1.0, 2.0] {
            visited.rest(at(x));
        }
        assert_eq!((visited.back(), visited.back(), visited.back()), (Some(at(1.0)), Some(at(0.0)), None));
        visited.rest(at(0.0));
        assert_eq!(visited.forward(), Some(at(1.0)), "the present view is no new place");
        visited.rest(at(5.0));
        assert_eq!((visited.forward(), visited.back()), (None, Some(at(1.0))), "a new place ends the way forward");
    }
}
