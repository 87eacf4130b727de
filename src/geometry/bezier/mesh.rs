//! Patches as a mesh of quads.

use super::{ControlNet, Patch};
use crate::math::Aabb;
use glam::{DVec2, DVec3};
use std::collections::HashMap;

/// A mesh of quads, and of triangles where an edge of a patch is a point. Corners that fall together share a vertex,
/// within a patch and between patches; normals and (u, v) belong to the corners of each patch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QuadMesh {
    /// Vertices.
    pub positions: Vec<DVec3>,
    /// Unit normals `dS/du x dS/dv`, one for each grid point of each patch.
    pub normals: Vec<DVec3>,
    /// Parameters, one for each grid point of each patch.
    pub parameters: Vec<DVec2>,
    /// Faces of three or four corners, counter-clockwise seen from where the normals point.
    pub faces: Vec<Vec<MeshCorner>>,
}

/// A corner of a face, by indices from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshCorner {
    /// Into `positions`.
    pub vertex: usize,
    /// Into `normals` and `parameters`.
    pub sample: usize,
}

/// Vertices closer than this, relative to the size of all patches, are one: far more than rounding, far less than any
/// detail.
const WELD_DISTANCE: f64 = 1e-7;

impl QuadMesh {
    /// The mesh with `steps` quads along each side of each patch; `steps` of 0 counts as 1.
    pub fn new(nets: &[ControlNet], steps: usize) -> Self {
        let steps = steps.max(1);
        let size = nets.iter().fold(Aabb::EMPTY, |bounds, net| bounds.union(&net.bounds())).diagonal();
        let mut mesh = Self::default();
        let mut weld = Weld { cell: WELD_DISTANCE * size, cells: HashMap::new() };
        for net in nets {
            mesh.add_patch(&Patch::new(*net), steps, &mut weld);
        }
        mesh
    }

    fn add_patch(&mut self, patch: &Patch, steps: usize, weld: &mut Weld) {
        let first = self.normals.len();
        let mut vertices = Vec::with_capacity((steps + 1) * (steps + 1));
        for k in 0..(steps + 1) * (steps + 1) {
            let (u, v) = ((k / (steps + 1)) as f64 / steps as f64, (k % (steps + 1)) as f64 / steps as f64);
            vertices.push(weld.vertex(patch.net().eval(u, v), &mut self.positions));
            self.normals.push(patch.normal(u, v));
            self.parameters.push(DVec2::new(u, v));
        }
        for i in 0..steps {
            for j in 0..steps {
                let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| {
                    let k = i * (steps + 1) + j;
                    MeshCorner { vertex: vertices[k], sample: first + k }
                });
                self.faces.extend(face(&corners));
            }
        }
    }

    /// The text of a Wavefront OBJ file with one object: all `v`, `vt` and `vn`, then the faces as `v/vt/vn`.
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
            for corner in face {
                text += &format!(" {}/{sample}/{sample}", corner.vertex + 1, sample = corner.sample + 1);
            }
            text.push('\n');
        }
        text
    }
}

/// The face without corners that repeat a vertex; none if fewer than three are left.
fn face(corners: &[MeshCorner; 4]) -> Option<Vec<MeshCorner>> {
    let mut face: Vec<MeshCorner> = Vec::with_capacity(4);
    for corner in corners {
        if face.iter().all(|c| c.vertex != corner.vertex) {
            face.push(*corner);
        }
    }
    (face.len() >= 3).then_some(face)
}

/// Finds vertices that are already there, by cells of a grid.
struct Weld {
    cell: f64,
    cells: HashMap<[i64; 3], usize>,
}

impl Weld {
    /// The index of a vertex at p, perhaps a new one.
    fn vertex(&mut self, p: DVec3, positions: &mut Vec<DVec3>) -> usize {
        // A point within half a cell of p lies in one of the eight cells around the corner nearest to p.
        let corner = |x: f64| if self.cell > 0.0 { (x / self.cell).round() as i64 } else { 0 };
        let [x, y, z] = p.to_array().map(corner);
        for k in 0..8 {
            let cell = [x - (k & 1), y - (k >> 1 & 1), z - (k >> 2)];
            if let Some(&index) = self.cells.get(&cell)
                && positions[index].distance(p) <= 0.5 * self.cell
            {
                return index;
            }
        }
        let floor = |x: f64| if self.cell > 0.0 { (x / self.cell).floor() as i64 } else { 0 };
        self.cells.insert(p.to_array().map(floor), positions.len());
        positions.push(p);
        positions.len() - 1
    }
}
