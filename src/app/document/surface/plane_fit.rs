//! The plane nearest to points.

use glam::{DMat3, DVec3};

/// Sweeps of Jacobi's method: it converges quadratically, and five sweeps reach rounding for three rows.
const SWEEPS: usize = 8;

/// The mean of the points and the unit normal of the plane through it with the least sum of squared distances; `None` for no
/// points.
pub(super) fn nearest_plane(points: &[DVec3]) -> Option<(DVec3, DVec3)> {
    let mean = points.iter().sum::<DVec3>() / points.len() as f64;
    let size = points.iter().map(|point| (*point - mean).length()).fold(0.0, f64::max);
    if points.is_empty() || !size.is_finite() {
        return None;
    }
    // Offsets of size 1, so that no square overflows or vanishes.
    let scale = if size > 0.0 { 1.0 / size } else { 1.0 };
    let covariance = points.iter().fold(DMat3::ZERO, |sum, point| {
        let offset = scale * (*point - mean);
        sum + DMat3::from_cols(offset.x * offset, offset.y * offset, offset.z * offset)
    });
    let (values, vectors) = eigen(covariance);
    let least = (0..3).min_by(|a, b| values[*a].total_cmp(&values[*b]))?;
    Some((mean, vectors.col(least).try_normalize()?))
}

/// The eigenvalues and eigenvectors (columns) of a symmetric matrix, by Jacobi's method.
fn eigen(mut matrix: DMat3) -> (DVec3, DMat3) {
    let mut vectors = DMat3::IDENTITY;
    for (p, q) in [(0, 1), (0, 2), (1, 2)].repeat(SWEEPS) {
        let (off, difference) = (matrix.col(q)[p], matrix.col(q)[q] - matrix.col(p)[p]);
        if off == 0.0 {
            continue;
        }
        // The smaller root of t^2 + t difference / off - 1 = 0 is the tangent of the rotation that annihilates `off`.
        let theta = 0.5 * difference / off;
        let tangent = theta.signum() / (theta.abs() + (1.0 + theta * theta).sqrt());
        let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
        let sine = tangent * cosine;
        let mut rotation = DMat3::IDENTITY;
        rotation.col_mut(p)[p] = cosine;
        rotation.col_mut(q)[q] = cosine;
        rotation.col_mut(q)[p] = sine;
        rotation.col_mut(p)[q] = -sine;
        matrix = rotation.transpose() * matrix * rotation;
        vectors *= rotation;
    }
    (DVec3::new(matrix.x_axis.x, matrix.y_axis.y, matrix.z_axis.z), vectors)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plane_of_points_in_a_plane_is_exact_at_any_size_and_place() {
        let normal = DVec3::new(2.0, -1.0, 0.5).normalize();
        let (a, b) = normal.any_orthonormal_pair();
        for (size, center) in [(1.0, DVec3::ZERO), (1e-6, DVec3::ONE), (1e6, DVec3::splat(-1e5))] {
            let points: Vec<DVec3> =
                (0..16).map(|k| center + size * ((k % 4) as f64 * a + (k / 4) as f64 * 0.5 * b)).collect();
            let (mean, found) = nearest_plane(&points).unwrap();
            // Offsets keep a sixteenth of the digits of positions a million times as large.
            assert!(found.dot(normal).abs() > 1.0 - 1e-12, "{found} at size {size}");
            assert!((mean - center).dot(normal).abs() < 1e-9 * size, "{mean}");
        }
    }

    #[test]
    fn the_plane_halves_what_lies_on_both_sides() {
        let points: Vec<DVec3> = [(-1.0, -1.0, 0.1), (-1.0, 1.0, -0.1), (1.0, -1.0, -0.1), (1.0, 1.0, 0.1)]
            .map(|(x, y, z)| DVec3::new(x, y, z))
            .to_vec();
        let (mean, normal) = nearest_plane(&points).unwrap();
        assert!(mean.length() < 1e-15 && normal.z.abs() > 1.0 - 1e-15, "{mean} {normal}");
        assert_eq!(nearest_plane(&[]), None);
        assert!(nearest_plane(&[DVec3::ONE; 5]).is_some(), "any plane through the point");
    }
}
