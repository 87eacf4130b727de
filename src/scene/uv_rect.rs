use glam::DVec2;

/// The part of texture space that a patch shows: the rectangle between the texture coordinates of two opposite corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvRect {
    /// The texture coordinates at (u, v) = (0, 0).
    pub start: DVec2,
    /// The texture coordinates at (u, v) = (1, 1).
    pub end: DVec2,
}

impl Default for UvRect {
    /// The whole texture, from 0 to 1.
    fn default() -> Self {
        Self { start: DVec2::ZERO, end: DVec2::ONE }
    }
}

impl UvRect {
    /// The vector from start to end.
    pub fn extent(&self) -> DVec2 {
        self.end - self.start
    }

    /// The texture coordinates at the parameters `uv` of the patch.
    pub fn at(&self, uv: DVec2) -> DVec2 {
        self.start + self.extent() * uv
    }

    /// The rectangles of the two halves of a patch that is split at u = 1/2.
    pub fn split_u(&self) -> [Self; 2] {
        let middle = 0.5 * (self.start.x + self.end.x);
        [Self { end: self.end.with_x(middle), ..*self }, Self { start: self.start.with_x(middle), ..*self }]
    }

    /// The rectangles of the two halves of a patch that is split at v = 1/2.
    pub fn split_v(&self) -> [Self; 2] {
        let middle = 0.5 * (self.start.y + self.end.y);
        [Self { end: self.end.with_y(middle), ..*self }, Self { start: self.start.with_y(middle), ..*self }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_meet_and_cover_the_whole() {
        let whole = UvRect { start: DVec2::new(0.25, 1.0), end: DVec2::new(0.75, -1.0) };
        let [low, high] = whole.split_u();
        assert_eq!((low.start, low.end), (whole.start, DVec2::new(0.5, -1.0)));
        assert_eq!((high.start, high.end), (DVec2::new(0.5, 1.0), whole.end));
        let [low, high] = whole.split_v();
        assert_eq!((low.start, low.end), (whole.start, DVec2::new(0.75, 0.0)));
        assert_eq!((high.start, high.end), (DVec2::new(0.25, 0.0), whole.end));
        assert_eq!(whole.at(DVec2::new(0.5, 0.25)), DVec2::new(0.5, 0.5));
    }
}
