//! Operations on the profile of a surface of revolution: control points (r, y) of cubic segments, each beginning at the end of
//! the one before.

use glam::DVec2;

/// The profile with a segment halved exactly; unchanged without such a segment.
pub(crate) fn split(profile: &[DVec2], segment: usize) -> Vec<DVec2> {
    let Some(&[a, b, c, d]) = profile.get(3 * segment..3 * segment + 4) else { return profile.to_vec() };
    // De Casteljau's algorithm at 1/2.
    let (ab, bc, cd) = (a.midpoint(b), b.midpoint(c), c.midpoint(d));
    let (left, right) = (ab.midpoint(bc), bc.midpoint(cd));
    let halves = [ab, left, left.midpoint(right), right, cd];
    [&profile[..=3 * segment], &halves, &profile[3 * segment + 3..]].concat()
}

/// The profile without a segment: the next one begins where the removed one began, or the profile ends there. Unchanged where it
/// has no such segment, or no other.
pub(crate) fn without_segment(profile: &[DVec2], segment: usize) -> Vec<DVec2> {
    if profile.len() <= 4 || 3 * segment + 3 >= profile.len() {
        return profile.to_vec();
    }
    [&profile[..=3 * segment], &profile[3 * segment + 4..]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn profile() -> Vec<DVec2> {
        (0..7).map(|k| DVec2::new(f64::from(k % 3), f64::from(k))).collect()
    }

    #[test]
    fn halves_meet_in_the_middle_of_the_segment() {
        let after = split(&profile(), 1);
        assert_eq!(after.len(), 10);
        assert_eq!((&after[..4], after[9]), (&profile()[..4], profile()[6]));
        let [a, b, c, d] = [profile()[3], profile()[4], profile()[5], profile()[6]];
        // Sums of small whole numbers over eight are exact.
        assert_eq!(after[6], (a + 3.0 * b + 3.0 * c + d) / 8.0);
        assert_eq!(split(&profile(), 2), profile());
    }

    #[test]
    fn the_profile_stays_connected_without_a_segment() {
        let before = profile();
        assert_eq!(without_segment(&before, 0), [before[0], before[4], before[5], before[6]]);
        assert_eq!(without_segment(&before, 1), before[..4]);
        assert_eq!(without_segment(&before, 2), before);
        assert_eq!(without_segment(&before[..4], 0), before[..4]);
    }
}
