//! Shapes and what a ray meets: sphere, quad, plane, Bezier patches, and the tree over them. Knows no material.

pub mod bezier;
