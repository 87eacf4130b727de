use crate::geometry::bezier::ControlNet;

/// The domain of a subpatch: a rectangle in `x = 2 u - 1` and `y = 2 v - 1`, by its center and half its size.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Domain {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) half_x: f64,
    pub(crate) half_y: f64,
}

impl Domain {
    /// The domain of a whole patch.
    pub(crate) const WHOLE: Self = Self { x: 0.0, y: 0.0, half_x: 1.0, half_y: 1.0 };

    /// The distance by which a point is outside of the domain enlarged by a factor and then by the slack, in units of
    /// half its size; negative inside, NaN for NaN.
    #[inline(always)]
    pub(crate) fn outside(&self, x: f64, y: f64, enlargement: f64, slack: Slack) -> f64 {
        let off = |distance: f64, half: f64, slack: f64| (distance.abs() - enlargement * half - slack) / half;
        let (x, y) = (off(x - self.x, self.half_x, slack.x), off(y - self.y, self.half_y, slack.y));
        // Keeps a NaN.
        if x > y { x } else { y }
    }

    /// The nearest point of the domain enlarged by a factor and then by the slack.
    #[inline(always)]
    pub(crate) fn clamped(&self, x: f64, y: f64, enlargement: f64, slack: Slack) -> (f64, f64) {
        let limit = |x: f64, middle: f64, half: f64, slack: f64| {
            let half = enlargement * half + slack;
            x.clamp(middle - half, middle + half)
        };
        (limit(x, self.x, self.half_x, slack.x), limit(y, self.y, self.half_y, slack.y))
    }

    /// The interval of u.
    #[inline(always)]
    pub(crate) fn interval_u(&self) -> (f64, f64) {
        (0.5 * (self.x - self.half_x) + 0.5, 0.5 * (self.x + self.half_x) + 0.5)
    }

    /// The interval of v.
    #[inline(always)]
    pub(crate) fn interval_v(&self) -> (f64, f64) {
        (0.5 * (self.y - self.half_y) + 0.5, 0.5 * (self.y + self.half_y) + 0.5)
    }

    /// The halves below and above the center in x.
    #[inline(always)]
    pub(crate) fn halves_x(&self) -> [Self; 2] {
        let half_x = 0.5 * self.half_x;
        [Self { x: self.x - half_x, half_x, ..*self }, Self { x: self.x + half_x, half_x, ..*self }]
    }

    /// The halves below and above the center in y.
    #[inline(always)]
    pub(crate) fn halves_y(&self) -> [Self; 2] {
        let half_y = 0.5 * self.half_y;
        [Self { y: self.y - half_y, half_y, ..*self }, Self { y: self.y + half_y, half_y, ..*self }]
    }
}

/// The distance outside of a subpatch's domain up to which a root is a hit, in x and y. Neighbouring subpatches and
/// patches overlap by more than rounding, so that no ray slips between them, and by an invisible amount. Where a
/// derivative vanishes, domains that overlap do not overlap in space; there subdivision decides, with a slack of its
/// own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slack {
    x: f64,
    y: f64,
}

impl Slack {
    /// The slack of a patch that has this net in unit space.
    pub(crate) fn new(net: &ControlNet) -> Self {
        Self { x: along(&net.transposed()), y: along(net) }
    }
}

/// The overlap of neighbouring domains, in x and y.
const OVERLAP: f64 = 1e-9;
/// The least overlap in unit space, which widens the domains of narrow patches: a ray that starts thousands of patch sizes
/// away has lost some digits.
const OVERLAP_IN_SPACE: f64 = 1e-11;
/// The largest overlap, in x and y, however narrow the patch is.
const MAX_OVERLAP: f64 = 1e-6;

/// The slack along v.
fn along(net: &ControlNet) -> f64 {
    let differences = net.points.iter().flat_map(|row| row.windows(2).map(|pair| pair[0].distance(pair[1])));
    // Three differences of control points over the two units of y.
    let longest = 1.5 * differences.fold(0.0, f64::max);
    (OVERLAP + OVERLAP_IN_SPACE / longest).min(MAX_OVERLAP)
}
