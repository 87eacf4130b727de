use glam::DVec3;

/// The 4 x 4 control points of a bicubic patch: `points[i][j]`, i along u, j along v,
/// `S(u, v) = sum B_i(u) B_j(v) points[i][j]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlNet {
    /// Scene units.
    pub points: [[DVec3; 4]; 4],
}
