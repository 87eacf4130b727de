use super::{
    checks::{Checks, MAX_LENGTH, MIN_LENGTH, is_point, parallel},
    names::Names,
};
use crate::scene::{Bezier, Emitter, Light, Object, Revolution, Shape, Transform, UvRect};
use glam::{DVec2, DVec3};

/// Checks a light.
pub(super) fn light(light: &Light, checks: &mut Checks<'_>) {
    match light.emitter {
        Emitter::Point { position, intensity } => {
            checks.point("position", position);
            checks.radiance("intensity", intensity);
        }
        Emitter::Sphere { center, radius, radiance } => {
            checks.point("center", center);
            checks.length("radius", radius);
            checks.radiance("radiance", radiance);
        }
        Emitter::Quad { corner, edge_u, edge_v, radiance } => {
            parallelogram(corner, edge_u, edge_v, checks);
            checks.radiance("radiance", radiance);
        }
        Emitter::Sun { direction, irradiance, diameter } => {
            checks.direction("direction", direction);
            checks.radiance("irradiance", irradiance);
            checks.within("diameter", diameter, 0.0, Emitter::MOST_DIAMETER);
        }
        Emitter::Beam { center, direction, radius, power } => {
            checks.point("center", center);
            checks.direction("direction", direction);
            checks.length("radius", radius);
            checks.radiance("power", power);
        }
    }
}

/// Checks an object.
pub(super) fn object(object: &Object, names: &Names<'_>, checks: &mut Checks<'_>) {
    checks.name("material", &object.material, "material", &names.materials);
    match &object.shape {
        Shape::Quad { corner, edge_u, edge_v } => parallelogram(*corner, *edge_u, *edge_v, checks),
        Shape::Sphere { center, radius } => {
            checks.point("center", *center);
            checks.length("radius", *radius);
        }
        Shape::Plane { point, normal, u_axis } => plane(*point, *normal, *u_axis, checks),
        Shape::Bezier(b) => bezier(b, checks),
        Shape::Revolution(r) => revolution(r, checks),
    }
}

fn parallelogram(corner: DVec3, edge_u: DVec3, edge_v: DVec3, checks: &mut Checks<'_>) {
    checks.point("corner", corner);
    checks.direction("edge_u", edge_u);
    checks.direction("edge_v", edge_v);
    let flat = parallel(edge_u, edge_v) && edge_u.length() >= MIN_LENGTH && edge_v.length() >= MIN_LENGTH;
    checks.require(!flat, "edge_v", || {
        format!("found {edge_v}, expected a direction that is not parallel to edge_u {edge_u}")
    });
}

fn plane(point: DVec3, normal: DVec3, u_axis: Option<DVec3>, checks: &mut Checks<'_>) {
    checks.point("point", point);
    checks.direction("normal", normal);
    if let Some(u_axis) = u_axis {
        checks.direction("u_axis", u_axis);
        checks.require(!parallel(normal, u_axis) || u_axis.length() < MIN_LENGTH, "u_axis", || {
            format!("found {u_axis}, expected a direction that is not parallel to the normal {normal}")
        });
    }
}

fn bezier(bezier: &Bezier, checks: &mut Checks<'_>) {
    transform(&bezier.transform, &mut checks.at("transform"));
    checks.require(bezier.file.as_deref() != Some(""), "file", || {
        "found an empty path, expected the path of a .bpt file".into()
    });
    if let Some(uv) = &bezier.uv {
        uv_rects(uv, bezier.patches.len(), checks);
    }
    checks.require(!bezier.patches.is_empty(), "patches", || "found no patch, expected at least one".into());
    for (k, net) in bezier.patches.iter().enumerate() {
        for (i, row) in net.points.iter().enumerate() {
            for (j, point) in row.iter().enumerate().filter(|(_, p)| !is_point(**p)) {
                checks.point(&format!("patches[{k}][{i}][{j}]"), *point);
            }
        }
    }
}

fn revolution(revolution: &Revolution, checks: &mut Checks<'_>) {
    transform(revolution.transform(), &mut checks.at("transform"));
    let (angle, points) = (revolution.angle(), revolution.profile());
    checks.require(angle > 0.0 && angle <= 360.0, "angle", || {
        format!("found {angle:?}, expected degrees above 0 and up to 360")
    });
    let count = points.len();
    checks.require(count >= 4 && count % 3 == 1, "profile", || {
        format!(
            "found {count} points, expected 4, 7, 10, ...: each cubic segment adds three to the point where it begins"
        )
    });
    checks.require(count <= Revolution::MOST_POINTS, "profile", || {
        format!("found {count} points, expected at most {}", Revolution::MOST_POINTS)
    });
    let fits = |point: &DVec2| (0.0..=MAX_LENGTH).contains(&point.x) && point.y.abs() <= MAX_LENGTH;
    for (k, point) in points.iter().enumerate().filter(|(_, point)| !fits(point)) {
        checks.require(false, &format!("profile[{k}]"), || {
            format!(
                "found {:?}, expected a point [r, y] with r from 0 to {MAX_LENGTH:?} and y from {:?} to {MAX_LENGTH:?}",
                point.to_array(),
                -MAX_LENGTH
            )
        });
    }
    let has_area = points.is_empty() || points.iter().any(|point| point.x != 0.0);
    checks.require(has_area, "profile", || {
        "found r = 0 in every point, expected a profile that leaves the axis of the turn".into()
    });
}

fn uv_rects(uv: &[UvRect], patches: usize, checks: &mut Checks<'_>) {
    // Patches that are missing are a problem of their own.
    checks.require(uv.len() == patches || patches == 0, "uv", || {
        format!("found {}, expected a rectangle for each patch: {patches}", uv.len())
    });
    for (k, rect) in uv.iter().enumerate() {
        let [u0, v0, u1, v1] = [rect.start.x, rect.start.y, rect.end.x, rect.end.y];
        let is_usable = [u0, v0, u1, v1].iter().all(|x| x.abs() <= MAX_LENGTH) && u0 != u1 && v0 != v1;
        checks.require(is_usable, &format!("uv[{k}]"), || {
            format!("found [{u0:?}, {v0:?}, {u1:?}, {v1:?}], expected [u0, v0, u1, v1] up to {MAX_LENGTH:?}, with u0 other than u1 and v0 than v1")
        });
    }
}

fn transform(transform: &Transform, checks: &mut Checks<'_>) {
    checks.point("translate", transform.translate);
    checks.point("rotate", transform.rotate);
    for (index, factor) in transform.scale.to_array().into_iter().enumerate() {
        checks.require((1e-6..=1e6).contains(&factor.abs()), &format!("scale[{index}]"), || {
            format!("found {factor}, expected a factor from 1e-6 to 1e6, or from -1e6 to -1e-6 to mirror")
        });
    }
}
