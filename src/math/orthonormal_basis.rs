use glam::DVec3;

/// An orthonormal basis around a normal: local x, y, z are `tangent`, `bitangent`, `normal`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrthonormalBasis {
    /// Local x, unit length.
    pub tangent: DVec3,
    /// Local y, unit length.
    pub bitangent: DVec3,
    /// Local z, unit length.
    pub normal: DVec3,
}

impl OrthonormalBasis {
    /// A basis with this unit normal, without poles \[Duff17\].
    pub fn from_normal(normal: DVec3) -> Self {
        let sign = 1f64.copysign(normal.z);
        let a = -1.0 / (sign + normal.z);
        let b = normal.x * normal.y * a;
        Self {
            tangent: DVec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
            bitangent: DVec3::new(b, sign + normal.y * normal.y * a, -normal.y),
            normal,
        }
    }

    /// The basis with this unit normal, with the tangent along the projection of `dpdu` and the bitangent on the side of
    /// `dpdv`. Falls back to [`OrthonormalBasis::from_normal`] where `dpdu` is zero or along the normal.
    pub fn from_derivatives(normal: DVec3, dpdu: DVec3, dpdv: DVec3) -> Self {
        let across = dpdu - normal * normal.dot(dpdu);
        if across.length_squared() <= 1e-20 * dpdu.length_squared() {
            return Self::from_normal(normal);
        }
        let Some(tangent) = across.try_normalize() else {
            return Self::from_normal(normal);
        };
        let bitangent = normal.cross(tangent);
        let bitangent = if bitangent.dot(dpdv) < 0.0 { -bitangent } else { bitangent };
        Self { tangent, bitangent, normal }
    }

    /// World coordinates of a local vector.
    pub fn world_from_local(&self, v: DVec3) -> DVec3 {
        v.x * self.tangent + v.y * self.bitangent + v.z * self.normal
    }
}
