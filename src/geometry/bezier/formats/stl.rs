//! Binary STL: the triangles of a mesh, for printers.

use crate::geometry::bezier::mesh::QuadMesh;
use glam::DVec3;

/// The STL file of a mesh. Faces of four corners become two triangles along their shorter diagonal. Coordinates are 32-bit floats: triangles
/// of which two corners become the same point are left out, and their neighbours meet there.
pub fn write_stl(mesh: &QuadMesh) -> Vec<u8> {
    let corners = |face: &[usize; 3]| face.map(|vertex| mesh.positions[vertex].as_vec3());
    let has_area = |face: &[usize; 3]| {
        let [a, b, c] = corners(face);
        a != b && b != c && c != a
    };
    let triangles: Vec<[usize; 3]> = mesh.faces.iter().flat_map(|face| halves(mesh, face)).filter(has_area).collect();
    // A header that begins with "solid" would be taken for the text form.
    let mut bytes = format!("{:80}", "binary STL").into_bytes();
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in &triangles {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex]);
        let normal = (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::ZERO).as_vec3();
        for vector in [normal].into_iter().chain(corners(triangle)) {
            bytes.extend(vector.to_array().iter().flat_map(|x| x.to_le_bytes()));
        }
        // Attributes, unused.
        bytes.extend([0; 2]);
    }
    bytes
}

/// The triangles of a face.
fn halves(mesh: &QuadMesh, face: &[usize]) -> Vec<[usize; 3]> {
    match *face {
        [a, b, c, d] => {
            let diagonal = |p: usize, q: usize| mesh.positions[p].distance_squared(mesh.positions[q]);
            if diagonal(a, c) <= diagonal(b, d) { vec![[a, b, c], [a, c, d]] } else { vec![[a, b, d], [b, c, d]] }
        }
        [a, b, c] => vec![[a, b, c]],
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(positions: &[[f64; 3]], faces: &[&[usize]]) -> QuadMesh {
        QuadMesh {
            positions: positions.iter().copied().map(DVec3::from_array).collect(),
            faces: faces.iter().map(|face| face.to_vec()).collect(),
            ..QuadMesh::default()
        }
    }

    fn float(bytes: &[u8], at: usize) -> f32 {
        f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
    }

    #[test]
    fn faces_become_triangles_that_face_the_same_way() {
        // A kite, whose shorter diagonal joins the second corner with the fourth.
        let kite =
            mesh(&[[0.0, 0.0, 0.0], [1.0, -0.5, 0.0], [3.0, 0.0, 0.0], [1.0, 0.5, 0.0]], &[&[0, 1, 2, 3], &[0, 1, 3]]);
        let bytes = write_stl(&kite);
        assert_eq!(bytes.len(), 84 + 3 * 50);
        assert_eq!(bytes[80..84], 3_u32.to_le_bytes());
        let first = 84;
        assert_eq!([0, 4, 8].map(|at| float(&bytes, first + at)), [0.0, 0.0, 1.0], "the normal");
        assert_eq!([36, 40, 44].map(|at| float(&bytes, first + at)), [1.0, 0.5, 0.0], "the third corner");
        assert!(!bytes.starts_with(b"solid"));
    }

    #[test]
    fn triangles_without_an_area_are_left_out() {
        let tiny = mesh(&[[1.0, 0.0, 0.0], [1.0 + 1e-12, 0.0, 0.0], [1.0, 1.0, 0.0]], &[&[0, 1, 2]]);
        assert_eq!(write_stl(&tiny).len(), 84);
    }
}
