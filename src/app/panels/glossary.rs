//! The explanations of the names in the side panels, for tooltips.

use egui::{Response, Ui};
use std::borrow::Cow;

/// Each name with its explanation.
const TIPS: &[(&str, &str)] = &[
    ("Name", "The name in lists and in the scene file, unique among the items of its kind"),
    ("Scene name", "The title of the scene"),
    ("Material", "How the surface scatters light; several objects may share a material"),
    (
        "Body",
        "The piece of glass that the surface bounds; surfaces of one body have one name. Empty: all surfaces of the material",
    ),
    ("Type", "The kind of material or light; colours that both kinds have are kept"),
    ("Preset", "Takes the parameters of real glass, metal or paint; the name, the relief and the priority stay"),
    ("Angle", "How far the profile turns around the axis: 360° for all around"),
    ("Caps", "Discs from the axis to the ends of the profile, and walls at the ends of a turn of less than 360°"),
    ("Position", "A point in world space, scene units"),
    ("Target", "The point that the camera looks at, scene units"),
    ("Up", "The direction that points up in the picture"),
    ("Field of view", "The vertical angle of view"),
    ("Corner", "The corner where both edges begin, scene units"),
    ("Edge u", "The edge along which u grows, from the corner"),
    ("Edge v", "The edge along which v grows, from the corner"),
    ("Centre", "The middle, scene units"),
    ("Radius", "From the middle to the edge, scene units"),
    ("Point", "A point of the plane, scene units"),
    ("Normal", "The direction that the front faces"),
    ("Texture", "The direction along which the texture repeats"),
    ("u axis", "The direction in which u grows"),
    ("Translate", "Where the object's origin lies in the world, scene units"),
    ("Rotate", "Angles about x, then y, then z"),
    ("Scale", "Factors along the object's axes; negative ones mirror"),
    ("Albedo", "The fraction of light that the surface scatters in all directions"),
    ("Specular", "The fraction of light that the highlight reflects"),
    ("Exponent", "The sharpness of the highlight: a larger one is sharper"),
    ("Reflectance", "The fraction of light that is reflected as by a mirror"),
    ("Index of refraction", "How strongly light bends: 1.33 for water, 1.5 for glass, 2.42 for diamond"),
    ("Tint", "The fraction of light that passes the surface; absorption colours thick glass more than thin"),
    ("Absorption", "How fast light fades in the glass, per scene unit"),
    ("Priority", "Where bodies of glass overlap, the highest priority counts; among equals the smaller body"),
    ("Bump or normal map", "A texture that bends the normals, so that the surface looks rough"),
    ("Normal map", "The texture whose red, green and blue are the normal"),
    ("Height map", "The texture whose brightness is the height"),
    ("Strength", "How far the normals bend: 1 as in the map, 0 not at all"),
    ("Depth", "The height of white above black, scene units"),
    ("Intensity", "Power for each solid angle, in the strongest of red, green and blue"),
    ("Radiance", "Brightness of the light's surface, in the strongest of red, green and blue"),
    ("Irradiance", "Power on each area that faces the light, in the strongest of red, green and blue"),
    ("Power", "Power of the whole beam, in the strongest of red, green and blue"),
    ("Direction", "Where the light shines to"),
    ("Diameter", "Angle that the sun takes in the sky: a larger one makes softer shadows"),
    ("Colour", "Red, green and blue, of which the strongest is 1"),
    ("File", "The path of the image; a relative one starts at the scene file's folder"),
    ("Encoding", "How the numbers of the image stand for brightness"),
    ("Size", "Width and height of the picture, pixels"),
    ("Exposure", "Stops of the display and of PNG files: one more is twice as bright. Does not restart rendering"),
    ("Tone curve", "How bright light is shown: clipped, or rolled off as by film. Does not restart rendering"),
    ("Bounces", "Most scattering events on a path; 1 renders direct light only"),
    ("Background", "Radiance where no object is"),
    ("Time left", "The rendering time until the error that is asked for, if the error falls as it did lately"),
    ("Stop at error", "Rendering stops when the error is hardly above this; 0 never stops"),
    ("Error", "Estimated root mean square error of the pixels, over the mean of the picture"),
];

/// The explanation of a name; empty for a name that needs none.
pub(super) fn tip(name: &str) -> &'static str {
    TIPS.iter().find(|(known, _)| *known == name).map_or("", |(_, tip)| tip)
}

/// The label of a row, explained where the pointer rests on it.
pub(super) fn caption(ui: &mut Ui, name: &str) {
    explained(ui.label(in_two_lines(name)), name);
}

/// The label of a row whose fields leave no room for their unit, with the unit below the name.
pub(super) fn caption_with_unit(ui: &mut Ui, name: &str, unit: &str) {
    let label = ui.vertical(|ui| {
        ui.spacing_mut().item_spacing.y = 0.0;
        let label = ui.label(name);
        label.union(ui.weak(unit))
    });
    explained(label.inner, name);
}

/// Longest name on one line: longer ones would narrow the column of the fields.
const LINE: usize = 14;

/// A long name, broken at the space nearest to its middle.
fn in_two_lines(name: &str) -> Cow<'_, str> {
    let middle = name.len() / 2;
    let spaces = name.match_indices(' ').map(|(at, _)| at);
    match spaces.min_by_key(|at| at.abs_diff(middle)).filter(|_| name.len() > LINE) {
        Some(at) => Cow::Owned(format!("{}\n{}", &name[..at], &name[at + 1..])),
        None => Cow::Borrowed(name),
    }
}

/// A widget with the explanation of its name as a tooltip.
pub(super) fn explained(response: Response, name: &str) -> Response {
    let tip = tip(name);
    if tip.is_empty() { response } else { response.on_hover_text(tip) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_names_break_at_the_middle() {
        assert_eq!(in_two_lines("Bump or normal map"), "Bump or\nnormal map");
        assert_eq!(in_two_lines("Albedo"), "Albedo");
    }

    #[test]
    fn each_name_is_explained_once() {
        for (index, (name, tip)) in TIPS.iter().enumerate() {
            assert!(!tip.is_empty() && TIPS[..index].iter().all(|(other, _)| other != name), "{name}");
        }
        assert!(tip("Tint").contains("fraction") && tip("No such name").is_empty());
    }
}
