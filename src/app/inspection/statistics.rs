//! Least, mean and greatest number over an object.

use super::field::Field;
use std::collections::BTreeMap;

/// The numbers of an object, over the pixels that show it alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Statistics {
    pub(super) least: f32,
    pub(super) mean: f32,
    pub(super) greatest: f32,
}

impl Statistics {
    /// The numbers of each object in a field that some pixel shows alone, with a number there.
    pub(super) fn of_objects(field: &Field) -> BTreeMap<u32, Self> {
        let mut sums: BTreeMap<u32, (f32, f64, u32, f32)> = BTreeMap::new();
        let numbers = field.values.iter().zip(&field.objects).enumerate();
        for (index, (value, object)) in numbers.filter(|(_, (value, _))| value.is_finite()) {
            if let Some(object) = object.filter(|_| field.is_inside_object(index)) {
                let (least, sum, count, greatest) =
                    sums.entry(object).or_insert((f32::INFINITY, 0.0, 0, f32::NEG_INFINITY));
                (*least, *greatest) = (least.min(*value), greatest.max(*value));
                *sum += f64::from(*value);
                *count += 1;
            }
        }
        let mean = |(least, sum, count, greatest)| Self { least, mean: (sum / f64::from(count)) as f32, greatest };
        sums.into_iter().map(|(object, sums)| (object, mean(sums))).collect()
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
        let all = Statistics::of_objects(&field);
        let statistics = all[&0];
        assert_eq!((statistics.least, statistics.greatest), (0.0, 31.0));
        assert!((statistics.mean - (6.0 * 15.0 * 2.0 + 6.0 - 7.0) / 11.0).abs() < 1e-4, "{statistics:?}");
        assert_eq!(all.keys().copied().collect::<Vec<_>>(), [0, 1]);
    }
}
