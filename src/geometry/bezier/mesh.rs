//! Tessellation: patches as a mesh of quads.

use super::Patch;
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// A mesh of quads, and of triangles where an edge of a patch is a point. Coincident corners become one vertex, within
/// a patch and between patches, so that closed surfaces give closed meshes. A vertex has one normal and one (u, v),
/// also on creases and between patches with different parameters: other programs split a mesh where vertices have
/// several.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QuadMesh {
    /// The vertices, in scene units.
    pub positions: Vec<DVec3>,
    /// For each vertex, the unit vector along the mean of the patches' normals.
    pub normals: Vec<DVec3>,
    /// For each vertex, its (u, v) on the first patch that has it.
    pub parameters: Vec<DVec2>,
    /// Faces as indices of three or four vertices, counter-clockwise when the normals point to the viewer.
    pub faces: Vec<Vec<usize>>,
}

/// Vertices closer than this are welded; relative to the size of the smallest patch, and far smaller than any detail.
const WELD_DISTANCE: f64 = 1e-7;
/// The least distance of welding, relative to the largest coordinate: above rounding.
const ROUNDING: f64 = 1e-14;

impl QuadMesh {
    /// The mesh of these patches, with `steps` quads (at least 1) along each side of each patch.
    pub fn new(patches: &[Patch], steps: usize) -> Self {
        let steps = steps.max(1);
        let mut mesh = Self::default();
        let mut weld = Weld { distance: weld_distance(patches), cells: HashMap::new() };
        for patch in patches {
            mesh.add_patch(patch, steps, &mut weld);
        }
        for normal in &mut mesh.normals {
            *normal = normal.try_normalize().unwrap_or(DVec3::Z);
        }
        mesh
    }

    fn add_patch(&mut self, patch: &Patch, steps: usize, weld: &mut Weld) {
        let mut vertices = Vec::with_capacity((steps + 1) * (steps + 1));
        for k in 0..(steps + 1) * (steps + 1) {
            let (u, v) = ((k / (steps + 1)) as f64 / steps as f64, (k % (steps + 1)) as f64 / steps as f64);
            let vertex = weld.vertex(patch.net().eval(u, v), &mut self.positions);
            if vertex == self.normals.len() {
                self.normals.push(DVec3::ZERO);
                self.parameters.push(DVec2::new(u, v));
            }
            self.normals[vertex] += patch.normal(u, v);
            vertices.push(vertex);
        }
        for i in 0..steps {
            for j in 0..steps {
                let mut corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                if patch.is_mirrored() {
                    corners.reverse();
                }
                self.faces.extend(face(corners.map(|(i, j)| vertices[i * (steps + 1) + j])));
            }
        }
    }

    /// The text of a Wavefront OBJ file with one object of this name.
    pub fn to_obj(&self, name: &str) -> String {
        let mut text = format!("o {name}\n");
        for p in &self.positions {
            text += &format!("v {} {} {}\n", p.x, p.y, p.z);
        }
        for uv in &self.parameters {
            text += &format!("vt {} {}\n", uv.x, uv.y);
        }
        for n in &self.normals {
            text += &format!("vn {} {} {}\n", n.x, n.y, n.z);
        }
        for face in &self.faces {
            text.push('f');
            for vertex in face {
                text += &format!(" {n}/{n}/{n}", n = vertex + 1);
            }
            text.push('\n');
        }
        text
    }
}

/// The face without repeated vertices; `None` if fewer than three are left.
fn face(corners: [usize; 4]) -> Option<Vec<usize>> {
    let mut face: Vec<usize> = Vec::with_capacity(4);
    for vertex in corners {
        if !face.contains(&vertex) {
            face.push(vertex);
        }
    }
    (face.len() >= 3).then_some(face)
}

/// The distance below which vertices are welded, in scene units.
fn weld_distance(patches: &[Patch]) -> f64 {
    let nets = || patches.iter().map(Patch::net);
    let sizes = nets().map(|net| net.bounds().diagonal()).filter(|size| *size > 0.0);
    let smallest = sizes.reduce(f64::min).unwrap_or(0.0);
    let largest = nets().flat_map(|net| net.points.as_flattened()).fold(0.0, |most, p| p.abs().max_element().max(most));
    (WELD_DISTANCE * smallest).max(ROUNDING * largest)
}

/// Finds existing vertices in the cells of a grid.
struct Weld {
    /// Vertices within this distance become one vertex; the cells are twice as wide.
    distance: f64,
    cells: HashMap<[i64; 3], Vec<usize>>,
}

impl Weld {
    /// The index of the vertex at p; adds a vertex where none exists.
    fn vertex(&mut self, p: DVec3, positions: &mut Vec<DVec3>) -> usize {
        let scale = if self.distance > 0.0 { 0.5 / self.distance } else { 0.0 };
        // Points within half a cell of p lie in the eight cells around the cell corner nearest to p.
        let [x, y, z] = p.to_array().map(|x| (x * scale).round() as i64);
        for k in 0..8 {
            let near = self.cells.get(&[x - (k & 1), y - (k >> 1 & 1), z - (k >> 2)]);
            let same = |index: &&usize| positions[**index].distance(p) <= self.distance;
            if let Some(index) = near.and_then(|indices| indices.iter().find(same)) {
                return *index;
            }
        }
        self.cells.entry(p.to_array().map(|x| (x * scale).floor() as i64)).or_default().push(positions.len());
        positions.push(p);
        positions.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::bezier::ControlNet;

    fn mesh_of(nets: &[ControlNet], steps: usize) -> QuadMesh {
        QuadMesh::new(&nets.iter().map(|net| Patch::new(*net)).collect::<Vec<_>>(), steps)
    }

    /// A cube whose six faces are patches with corners in any order.
    fn cube() -> Vec<ControlNet> {
        let face = |axis: usize, side: f64| {
            let point = |i: usize, j: usize| {
                let mut p = [0.0; 3];
                p[axis] = side;
                p[(axis + 1) % 3] = 2.0 / 3.0 * i as f64 - 1.0;
                // Opposite faces have opposite orientations, so that all normals point outward.
                p[(axis + 2) % 3] = side * (2.0 / 3.0 * j as f64 - 1.0);
                DVec3::from_array(p)
            };
            ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| point(i, j))) }
        };
        (0..6).map(|k| face(k / 2, [-1.0, 1.0][k % 2])).collect()
    }

    #[test]
    fn a_closed_body_is_welded_shut() {
        let mesh = mesh_of(&cube(), 4);
        assert_eq!(mesh.faces.len(), 6 * 16);
        // Euler: a closed quad mesh of genus 0 has two more vertices than faces.
        assert_eq!((mesh.positions.len(), mesh.parameters.len(), mesh.normals.len()), (98, 98, 98));
        assert_closed(&mesh);
    }

    #[test]
    fn a_small_body_beside_a_large_one_is_welded_shut_too() {
        let cube_at = |size: f64, at: f64| cube().into_iter().map(move |net| net.map(|p| size * p + DVec3::splat(at)));
        let mesh = mesh_of(&cube_at(1e6, -2e6).chain(cube_at(1e-3, 0.0)).collect::<Vec<_>>(), 4);
        assert_eq!(mesh.positions.len(), 2 * 98);
        assert_closed(&mesh);
    }

    fn assert_closed(mesh: &QuadMesh) {
        let mut edges = std::collections::BTreeMap::<(usize, usize), usize>::new();
        for face in &mesh.faces {
            for k in 0..face.len() {
                *edges.entry((face[k], face[(k + 1) % face.len()])).or_default() += 1;
            }
        }
        for (&(a, b), &count) in &edges {
            assert_eq!((count, edges.get(&(b, a))), (1, Some(&1)), "edge {a} {b} has a face on either side");
        }
    }

    #[test]
    fn collapsed_edges_give_triangles_and_points_give_no_face() {
        let mut net = cube()[0];
        net.points[0] = [net.points[0][0]; 4];
        let mesh = mesh_of(&[net], 3);
        assert_eq!(mesh.faces.iter().filter(|f| f.len() == 3).count(), 3);
        assert!(mesh.normals.iter().all(|n| n.is_normalized()));
        assert!(mesh_of(&[net.map(|_| DVec3::ONE)], 3).faces.is_empty());
    }

    #[test]
    fn mirrored_patches_face_their_outside() {
        let mirrored = |net: ControlNet| Patch::new(net.map(|p| p * DVec3::new(-1.0, 1.0, 1.0))).mirrored(true);
        let mesh = QuadMesh::new(&cube().into_iter().map(mirrored).collect::<Vec<_>>(), 4);
        assert_closed(&mesh);
        for face in &mesh.faces {
            let corners = [0, 1, 2].map(|k| mesh.positions[face[k]]);
            let outward = (corners[1] - corners[0]).cross(corners[2] - corners[1]);
            assert!(outward.dot(corners[0]) > 0.0 && mesh.normals[face[0]].dot(corners[0]) > 0.0);
        }
    }

    #[test]
    fn objs_count_from_one() {
        let text = mesh_of(&cube()[..1], 1).to_obj("face");
        let faces: Vec<&str> = text.lines().filter(|line| line.starts_with('f')).collect();
        assert_eq!(faces, ["f 1/1/1 3/3/3 4/4/4 2/2/2"]);
        assert_eq!(text.lines().count(), 1 + 4 + 4 + 4 + 1);
    }
}
