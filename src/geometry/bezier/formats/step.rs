//! STEP (ISO 10303-21, application protocol 214): exact surfaces for CAD programs, each patch a `B_SPLINE_SURFACE_WITH_KNOTS`.

use crate::geometry::bezier::ControlNet;

/// The entities before the surfaces. `<name>` stands for the name of the product, `<surfaces>` for the references to
/// the surfaces.
const PRODUCT: &str = "\
#1=APPLICATION_CONTEXT('core data for automotive mechanical design processes');
#2=APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#1);
#3=PRODUCT_CONTEXT('',#1,'mechanical');
#4=PRODUCT('<name>','<name>','',(#3));
#5=PRODUCT_DEFINITION_FORMATION('','',#4);
#6=PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');
#7=PRODUCT_DEFINITION('design','',#5,#6);
#8=PRODUCT_DEFINITION_SHAPE('','',#7);
#9=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));
#10=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));
#11=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());
#12=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-7),#9,'distance_accuracy_value','');
#13=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#12))GLOBAL_UNIT_ASSIGNED_CONTEXT((#9,#10,#11))\
REPRESENTATION_CONTEXT('',''));
#14=GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION('',(#16),#13);
#15=SHAPE_DEFINITION_REPRESENTATION(#8,#14);
#16=GEOMETRIC_SET('',(<surfaces>));
";
/// The number of the first entity after these.
const FIRST: usize = 17;
/// Points of a patch, and its surface.
const ENTITIES_OF_PATCH: usize = 17;

/// The STEP text of a product of this name with a surface for each control net. A scene unit is a metre. Coordinates are the shortest decimals
/// that read back as the same `f64`.
pub fn write_step(name: &str, nets: &[ControlNet]) -> String {
    let name = escaped(name);
    let surface = |patch: usize| FIRST + ENTITIES_OF_PATCH * patch + 16;
    let surfaces: Vec<String> = (0..nets.len()).map(|patch| format!("#{}", surface(patch))).collect();
    let mut text = format!(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('bicubic Bezier patches'),'2;1');\nFILE_NAME('{name}','',(''),(''),'','','');\n\
         FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\nENDSEC;\nDATA;\n"
    );
    text += &PRODUCT.replace("<surfaces>", &surfaces.join(",")).replace("<name>", &name);
    for (patch, net) in nets.iter().enumerate() {
        let first = FIRST + ENTITIES_OF_PATCH * patch;
        for (number, p) in (first..).zip(net.points.iter().flatten()) {
            let [x, y, z] = p.to_array().map(real);
            text += &format!("#{number}=CARTESIAN_POINT('',({x},{y},{z}));\n");
        }
        let row = |i: usize| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|j| first + 4 * i + j);
            format!("(#{a},#{b},#{c},#{d})")
        };
        let rows = [0, 1, 2, 3].map(row).join(",");
        // A Bezier patch is a B-spline surface with knots of multiplicity four at its ends.
        text += &format!(
            "#{}=B_SPLINE_SURFACE_WITH_KNOTS('',3,3,({rows}),.UNSPECIFIED.,.F.,.F.,.F.,(4,4),(4,4),(0.,1.),(0.,1.),.UNSPECIFIED.);\n",
            surface(patch)
        );
    }
    text + "ENDSEC;\nEND-ISO-10303-21;\n"
}

/// A number with a decimal point, as the format demands.
fn real(x: f64) -> String {
    let text = format!("{x:?}").to_uppercase();
    match text.split_once('E') {
        Some((mantissa, exponent)) if !mantissa.contains('.') => format!("{mantissa}.E{exponent}"),
        _ => text,
    }
}

/// A text in quotes: other characters than those of ASCII are written by their codes.
fn escaped(text: &str) -> String {
    let escape = |c: char| match c {
        '\'' => "''".to_owned(),
        '\\' => "\\\\".to_owned(),
        ' '..='~' => c.to_string(),
        _ => format!("\\X4\\{:08X}\\X0\\", u32::from(c)),
    };
    text.chars().map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use std::array::from_fn;

    #[test]
    fn each_patch_is_a_surface_of_sixteen_points() {
        let net = |z: f64| ControlNet { points: from_fn(|i| from_fn(|j| DVec3::new(i as f64, 1e-7 * j as f64, z))) };
        let text = write_step("NAME's ä", &[net(0.0), net(2.5e300)]);
        assert_eq!(text.matches("NAMED_UNIT(*)").count(), 3);
        assert_eq!(text.matches("=CARTESIAN_POINT(").count(), 32);
        assert!(text.contains("#16=GEOMETRIC_SET('',(#33,#50));"));
        assert!(text.contains("#33=B_SPLINE_SURFACE_WITH_KNOTS('',3,3,((#17,#18,#19,#20),(#21,"));
        assert!(text.contains("#18=CARTESIAN_POINT('',(0.0,1.E-7,0.0));") && text.contains("2.5E300"));
        assert!(text.contains("PRODUCT('NAME''s \\X4\\000000E4\\X0\\',"), "{text}");
        // Every reference names an entity.
        let defined: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix('#')?.split('=').next()).collect();
        for reference in text.split('#').skip(1).map(|rest| rest.split(|c: char| !c.is_ascii_digit()).next().unwrap()) {
            assert!(defined.contains(&reference), "#{reference}");
        }
    }
}
