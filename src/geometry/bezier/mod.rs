//! Bicubic Bezier patches: evaluate, subdivide, bound, intersect, tessellate.
//!
//! | file | holds |
//! |---|---|
//! | `net` | [`ControlNet`]: the control points; evaluation and derivatives |
//! | `cubic` | a cubic Bezier curve: evaluation, subdivision |
//! | `surface` | [`Curvature`], area |
//! | `normal` | the unit normal, also where the cross product of the derivatives vanishes |
//! | `mesh` | [`QuadMesh`]: patches as a mesh, and its `.obj` |
//! | `revolution` | [`revolved`]: surfaces of revolution as patches |
//! | `formats/` | files of patches, to and from other programs |
//! | `unit/` | the unit space of a patch; control nets and rays laid out for SIMD |
//! | `tree/` | a patch cut into subpatches under a tree of boxes |
//! | `intersect/` | rays against that tree |
//! | `patch` | [`Patch`]: a patch for ray intersection |
//!
//! # Intersection
//!
//! 1. [`Patch::intersect`] maps the ray into the patch's unit space.
//! 2. The patch is cut into nearly flat subpatches under a BVH, whose boxes hold their control points: \[MCFS00\],
//!    \[GeimerAbert05\]; eight children per node side by side in SIMD lanes: \[DHK08\].
//! 3. In a leaf, the ray is intersected with paraboloids that approximate eight subpatches, with bounds of the error.
//!    The bounds limit the number of roots and their positions. (Ours.)
//! 4. Newton's method finds a root \[Kajiya82\], \[BarthStuerzlinger93\] and a bound of the Jacobian proves that it is
//!    the only root \[Toth85\].
//! 5. Where neither decides, the subpatch is halved in ray-aligned coordinates \[NSK90\], rotated to its longer side
//!    \[EHS05\], until Newton's method does.
//!
//! A packet of eight rays traverses the tree with a ray in each lane \[WSBW01\].
//!
//! # References
//!
//! - \[BarthStuerzlinger93\] W. Barth, W. Stuerzlinger, Efficient Ray Tracing for Bezier and B-Spline Surfaces, Computers &
//!   Graphics 17(4), 1993.
//! - \[DHK08\] H. Dammertz, J. Hanika, A. Keller, Shallow Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent
//!   Rays, EGSR 2008.
//! - \[EHS05\] A. Efremov, V. Havran, H.-P. Seidel, Robust and Numerically Stable Bezier Clipping Method for Ray Tracing NURBS
//!   Surfaces, SCCG 2005.
//! - \[FaroukiRajan88\] R. Farouki, V. Rajan, Algorithms for Polynomials in Bernstein Form, CAGD 5(1), 1988.
//! - \[Farin02\] G. Farin, Curves and Surfaces for CAGD, 5th edition, 2002.
//! - \[GeimerAbert05\] M. Geimer, O. Abert, Interactive Ray Tracing of Trimmed Bicubic Bezier Surfaces without Triangulation,
//!   WSCG 2005.
//! - \[Goldapp91\] M. Goldapp, Approximation of Circular Arcs by Cubic Polynomials, CAGD 8(3), 1991.
//! - \[Kajiya82\] J. Kajiya, Ray Tracing Parametric Patches, SIGGRAPH 1982.
//! - \[KayKajiya86\] T. Kay, J. Kajiya, Ray Tracing Complex Scenes, SIGGRAPH 1986.
//! - \[MCFS00\] W. Martin, E. Cohen, R. Fish, P. Shirley, Practical Ray Tracing of Trimmed NURBS Surfaces, JGT 5(1), 2000.
//! - \[NSK90\] T. Nishita, T. Sederberg, M. Kakimoto, Ray Tracing Trimmed Rational Surface Patches, SIGGRAPH 1990.
//! - \[Ramshaw89\] L. Ramshaw, Blossoms Are Polar Forms, CAGD 6(4), 1989.
//! - \[Toth85\] D. Toth, On Ray Tracing Parametric Surfaces, SIGGRAPH 1985.
//! - \[WSBW01\] I. Wald, P. Slusallek, C. Benthin, M. Wagner, Interactive Rendering with Coherent Ray Tracing, Eurographics
//!   2001.

mod cubic;
mod formats;
mod intersect;
mod mesh;
mod net;
mod normal;
mod patch;
mod revolution;
mod surface;
mod tree;
mod unit;

pub use formats::{
    FormatError, FormatProblem, PatchFormat, read_bpt, read_obj, read_pov, read_rib, write_bpt, write_obj, write_step,
    write_stl,
};
pub use mesh::QuadMesh;
pub use net::{ControlNet, Derivatives};
pub use patch::{Patch, PatchHit};
pub use revolution::{RevolvedPatch, revolved};
pub use surface::Curvature;
