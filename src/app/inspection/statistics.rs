//! Least, mean and greatest number over an object.

use super::field::Field;

/// The numbers of an object, over the pixels that show it alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Statistics {
    pub(super) least: f32,
    pub(super) mean: f32,
    pub(super) greatest: f32,
}

impl Statistics {
    /// The numbers of an object in a field; `None` where no pixel shows it alone, or has a number there.
    pub(super) fn of(field: &Field, object: u32) -> Option<Self> {
        let is_own = |index: &usize| field.objects[*index] == Some(object) && field.values[*index].is_finite();
        let (mut least, mut greatest, mut sum, mut count) = (f32::INFINITY, f32::NEG_INFINITY, 0.0, 0);
        for index in (0..field.values.len()).filter(is_own).filter(|index| field.is_inside_object(*index)) {
            let value = field.values[index];
            (least, greatest) = (least.min(value), greatest.max(value));
            sum += f64::from(value);
            count += 1;
        }
        (count > 0).then(|| Self { least, mean: (sum / f64::from(count)) as f32, greatest })
    }
}

#[cfg(test)]
mod tests {
    use super::super::field::tests::field;
    use super::*;

    #[test]
    fn only_pixels_that_show_the_object_alone_count() {
        let mut field = field(6, (0..36).map(|k| k as f32).collect());
        for index in 0..36 {
            field.objects[index] = Some(u32::from(index % 6 > 2));
        }
        field.values[7] = f32::NAN;
        // Of the columns 0 to 2, the third lies at the edge.
        let statistics = Statistics::of(&field, 0).unwrap();
        assert_eq!((statistics.least, statistics.greatest), (0.0, 31.0));
        assert!((statistics.mean - (6.0 * 15.0 * 2.0 + 6.0 - 7.0) / 11.0).abs() < 1e-4, "{statistics:?}");
        assert_eq!(Statistics::of(&field, 5), None);
    }
}
