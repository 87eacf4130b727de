//! Numbers along a line.

use super::field::Field;
use egui::Pos2;

/// Numbers along a line from one point of the film to another.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Profile {
    /// Where the samples lie, film pixels.
    pub(crate) places: Vec<Pos2>,
    /// The number at each sample; NaN where there is none.
    pub(crate) values: Vec<f32>,
}

impl Profile {
    /// The numbers of a field along a line between two points in film pixels, at least one for each pixel of its length.
    pub(super) fn along(field: &Field, [from, to]: [Pos2; 2]) -> Self {
        let count = (from.distance(to).ceil() as usize).max(1);
        let places: Vec<Pos2> = (0..=count).map(|k| from.lerp(to, k as f32 / count as f32)).collect();
        let value = |at: &Pos2| {
            let is_inside = at.x >= 0.0 && at.y >= 0.0;
            is_inside.then(|| field.at(at.x as usize, at.y as usize)).flatten().unwrap_or(f32::NAN)
        };
        let values = places.iter().map(value).collect();
        Self { places, values }
    }

    /// The distances of the samples from the first one, film pixels, and their numbers.
    pub(super) fn points(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let first = self.places.first().copied().unwrap_or_default();
        self.places.iter().zip(&self.values).map(move |(at, value)| [f64::from(first.distance(*at)), f64::from(*value)])
    }

    /// A table of the distance, column and row in film pixels and of the number, whose head has this name; an empty field where there is no
    /// number.
    pub(crate) fn csv(&self, name: &str) -> String {
        let mut text = format!("distance_px,column,row,{name}\n");
        for ([distance, value], at) in self.points().zip(&self.places) {
            let number = if value.is_finite() { value.to_string() } else { String::new() };
            text += &format!("{distance:.3},{:.3},{:.3},{number}\n", at.x, at.y);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::super::field::tests::field;
    use super::*;
    use egui::pos2;

    #[test]
    fn a_profile_has_a_number_for_each_pixel_on_its_way() {
        let field = field(10, (0..100).map(|k| (k % 10) as f32).collect());
        let profile = Profile::along(&field, [pos2(1.5, 3.5), pos2(8.5, 3.5)]);
        assert_eq!(profile.values, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        assert_eq!(profile.points().last(), Some([7.0, 8.0]));
        let beyond = Profile::along(&field, [pos2(-2.0, 3.5), pos2(20.0, 3.5)]);
        assert!(beyond.values[0].is_nan() && beyond.values.last().unwrap().is_nan());
        let csv = beyond.csv("irradiance");
        assert_eq!(csv.lines().next(), Some("distance_px,column,row,irradiance"));
        assert_eq!(csv.lines().nth(1), Some("0.000,-2.000,3.500,"));
        assert_eq!(Profile::along(&field, [pos2(1.5, 3.5); 2]).values.len(), 2, "a point");
    }
}
