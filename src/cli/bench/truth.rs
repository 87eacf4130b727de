use crate::film::{Errors, ImageError, LinearImage, Mask, compare, compare_with_both};
use crate::scene::Film;

/// The reference of a measurement.
pub(super) struct Truth {
    reference: LinearImage,
    /// A second reference, with which errors inside the mask exclude the noise of the references. Outside the mask, where the
    /// first reference is not trusted, errors are against the second reference alone.
    second: Option<LinearImage>,
    /// The mask and its complement.
    masks: Option<(Mask, Mask)>,
}

impl Truth {
    /// The reference of these images. Fails, before the rendering, if the size of the mask or of the second reference differs
    /// from the size of the first reference.
    pub(super) fn new(
        reference: LinearImage,
        second: Option<LinearImage>,
        mask: Option<Mask>,
    ) -> Result<Self, ImageError> {
        compare_with_both(&reference, &reference, second.as_ref().unwrap_or(&reference), mask.as_ref())?;
        let masks = mask.map(|mask| {
            let complement = mask.inverted();
            (mask, complement)
        });
        Ok(Self { reference, second, masks })
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        (self.reference.width, self.reference.height)
    }

    /// Whether there is a mask.
    pub(super) fn is_masked(&self) -> bool {
        self.masks.is_some()
    }

    /// The errors inside the mask, and the errors outside if there is a mask.
    ///
    /// # Errors
    ///
    /// If the image, a reference or the mask differ in size.
    pub(super) fn errors(&self, image: &LinearImage) -> Result<(Errors, Option<Errors>), ImageError> {
        let second = self.second.as_ref().unwrap_or(&self.reference);
        let errors = |mask| compare_with_both(image, &self.reference, second, mask);
        match &self.masks {
            None => Ok((errors(None)?, None)),
            Some((mask, complement)) => Ok((errors(Some(mask))?, Some(compare(image, second, Some(complement))?))),
        }
    }

    /// The mean FLIP inside and outside the mask, with the exposure and tone curve of a film; `None` without the feature `flip`.
    #[cfg(feature = "flip")]
    pub(super) fn flip(&self, image: &LinearImage, film: &Film) -> (Option<f64>, Option<f64>) {
        use crate::film::{ToneMap, flip, mean_inside};
        let tone = ToneMap::new(film.exposure, film.tone_curve);
        let differences = flip(&tone.map_image(image), &tone.map_image(&self.reference));
        let inside = mean_inside(&differences, self.masks.as_ref().map(|(mask, _)| mask));
        (Some(inside), self.masks.as_ref().map(|(_, complement)| mean_inside(&differences, Some(complement))))
    }

    /// `None`, without the feature `flip`.
    #[cfg(not(feature = "flip"))]
    pub(super) fn flip(&self, _: &LinearImage, _: &Film) -> (Option<f64>, Option<f64>) {
        (None, None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;

    #[test]
    fn the_mask_separates_errors() {
        let reference = LinearImage::black(2, 1);
        let image = LinearImage { pixels: vec![Rgb::splat(1.0), Rgb::splat(3.0)], ..reference.clone() };
        let mask = Mask { width: 2, height: 1, inside: vec![false, true] };
        let (inside, outside) = Truth::new(reference.clone(), None, Some(mask)).unwrap().errors(&image).unwrap();
        assert_eq!((inside.rmse, outside.unwrap().rmse), (3.0, 1.0));
        let (all, outside) = Truth::new(reference, None, None).unwrap().errors(&image).unwrap();
        assert_eq!((all.rmse, outside), (5f64.sqrt(), None));
    }

    #[test]
    fn two_references_count_inside_the_mask_and_the_second_outside() {
        let image = |values: [f32; 2]| LinearImage { width: 2, height: 1, pixels: values.map(Rgb::splat).to_vec() };
        let mask = Mask { width: 2, height: 1, inside: vec![false, true] };
        let truth = Truth::new(image([2.0, 2.0]), Some(image([-1.0, -5.0])), Some(mask)).unwrap();
        let (inside, outside) = truth.errors(&image([3.0, 3.0])).unwrap();
        assert_eq!((inside.rmse, outside.unwrap().rmse), (8f64.sqrt(), 4.0));
    }

    #[test]
    fn pictures_of_other_sizes_are_refused() {
        let mask = Mask { width: 1, height: 1, inside: vec![true] };
        let truth = |second, mask| Truth::new(LinearImage::black(2, 1), second, mask);
        assert!(truth(None, Some(mask)).is_err());
        assert!(truth(Some(LinearImage::black(1, 1)), None).is_err());
    }
}
