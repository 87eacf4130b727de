//! patchlight shows what light does with a curved surface: a progressive photon mapper for scenes of bicubic Bezier
//! patches, spheres and planes. A window shows a scene; the user drags a control point, a light or a material, and the
//! caustics form again at once; left alone, the picture converges.
//!
//! This page is the architecture.
//!
//! # Data flow
//!
//! ```text
//!  scenes/*.toml                      caller's thread         |          engine thread            rayon pool
//!       │ load, validate                                      |
//!       ▼                                                     |
//!     Scene ─────────► Document (Scene, selection, undo)      |
//!       ▲ save            │ panels and handles push commands  |
//!       │                 ▼                                   |
//!       └─────────── apply ── Scene' ── Engine::send ─────────┼─► newest wins
//!                             (a new generation: a pass       |        ▼
//!                              in flight gives up)            |   world::prepare(scene, previous) ─► World
//!                                                             |        ▼
//!                                                             |   Plan: what is needed, what is skipped, why
//!                                                             |        ▼
//!                                                             |   a draft, never cancelled, then finer ones, then 1, 2, ...
//!                                                             |   ┌─ iteration i ───────────────────────────────┐
//!                                                             |   │ photon passes ─► caustic, global photons    │
//!                                                             |   │ photon map    ─► kd-trees                   │
//!                                                             |   │ camera pass   ─► visible points, direct     │
//!                                                             |   │ gather        ─► radiance at visible points │
//!                                                             |   │ commit        ─► film, all or nothing       │
//!                                                             |   │   after 4, 8, ...: the plan is refined      │
//!                                                             |   └──────────────────┬──────────────────────────┘
//!    newest frame only, never an older generation ◄───────────┼── Frame { generation, iteration, image, stats }
//!       ▼                                                     |
//!    exposure, tone curve ─► texture ─► canvas ─► handles     |
//! ```
//!
//! The photon passes come first so that the camera pass and the gather can go through the film in bands: memory for
//! visible points does not grow with the picture. `patchlight render` and `bench` run a [`engine::Session`], the same
//! iterations without the thread.
//!
//! # Modules
//!
//! A module uses only what stands before it in this list.
//!
//! | module | holds | never knows |
//! |---|---|---|
//! | [`mod@file`] | writing a file whole or not at all | what it writes |
//! | [`math`] | rays, boxes, frames, error bounds, sampling warps, index-based random streams | colour, scenes, time |
//! | [`geometry`] | sphere, quad, plane, [`geometry::bezier`], the tree over primitives | materials, files, threads |
//! | [`scene`] | what the user describes: plain data; load, save, validate | trees, images, rendering, windows |
//! | [`world`] | what the renderer reads, prepared from a scene, immutable | passes, windows |
//! | [`film`] | linear images, tone curves, PNG and EXR, error metrics | who renders |
//! | [`transport`] | scattering, the plan, the passes, the photon map, the schedule | channels, clocks, files |
//! | [`engine`] | the worker, film sums, commands in, frames out, cancel, restart | windows, how surfaces scatter |
//! | [`cli`], `app` | the two front ends, side by side | each other |
//!
//! # Rules
//!
//! - A pass is a function of what stands in its signature. Random numbers depend on (seed, stream, iteration, index,
//!   dimension) alone, so one thread and many give the same bits.
//! - An iteration is a pure function of (world, plan, seed, i), so films of parts can be merged. Iterations differ in size
//!   by a fixed schedule; what photons bring counts in the mean by their size, camera samples by how many the pixels around
//!   ask for. The plan is refined after iterations 4, 8, 16, ... by what iterations measured: radii of density estimates,
//!   where caustics are gathered, and samples of each pixel.
//! - A cancelled pass returns nothing, and the film changes only by whole iterations.
//! - Colours are `f32`; positions, directions and distances are `f64`, because the offset that keeps a ray off the surface
//!   it leaves has to be small against the scene and large against rounding. Photons are stored in `f32`, relative to the
//!   middle of the scene.
//! - Nothing not finite enters the film; what is left out is counted and shown.
//!
//! # Glossary
//!
//! | word | meaning |
//! |---|---|
//! | iteration | one full round of the algorithm; a *pass* is one stage in it |
//! | path, vertex | light's way between a light and the camera, and its events |
//! | visible point | where a camera path meets a surface that scatters in many directions |
//! | photon | flux that arrived at a point, with its direction |
//! | patch, part, packet | a bicubic surface; one of the nearly flat pieces into which it is cut; shapes that a ray meets side by side: eight parts, four quads or spheres |
//! | throughput | what a path keeps of the light that enters at its end (beta in papers) |
//! | `wi`, `wo` | directions away from the surface: towards where light comes from, and where it goes |
//! | `n_geom`, `n_side`, `n_shade` | unit normal of the front; of the side at hand; as tilted by a relief map |
//! | `eta` | index of refraction behind an interface over the index in front of it |
//! | footprint | side of a pixel, projected to a distance |
//! | clearance | distance from a visible point to the next object: interreflection changes within a part of it |
//! | visibility polygon | what is seen of a plane from a visible point in it: what stands there hides photons beyond |
//! | tilt | a photon counts by how the surface looks where it is gathered, not where it arrived |
//! | leader | a visible point that gathers interreflection for its neighbours too |
//! | splat | a photon's light added to the pixel that sees it, where caustics are sharp |
//! | component | direct light, caustics or interreflection: every path of light belongs to one of them |
//! | contrast | how much brighter a visible point is in a wider disc: tells the bias of the density estimate |
//! | varied | of a pixel: it shows several surfaces or a texture |
//! | relevance | of a light: the part of its paths that reaches what the camera sees |
//! | share | of a light: about the part of the direct light at a point that is its own |
//! | bandwidth | radii of density estimates over the film, chosen by the contrasts |
//! | focused | of photons: sent on by mirrors or glass after they were scattered |
//! | lobe view | a Phong lobe as it shows one direction: tells which light seen in it is the camera's, and which photons bring; *seen lobe*: what a pixel finds in one and shares with its neighbours |
//! | lanes | numbers that one vector instruction handles side by side |
//! | control net | the 4 x 4 control points of a patch; `dpdu`, `dpdv` are the surface's derivatives |
//! | specular | going on in one direction: mirrors and glass; *glossy*: a Phong lobe |
//! | caustic | light that met mirrors or glass only, between the light and the visible point |
//!
//! # References
//!
//! - \[Andersson20\] P. Andersson et al., FLIP: A Difference Evaluator for Alternating Images, HPG 2020.
//! - \[Burley20\] B. Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020.
//! - \[Clarberg08\] P. Clarberg, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD, JGT 13(3), 2008.
//! - \[Duff17\] T. Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
//! - \[FanGijbels96\] J. Fan, I. Gijbels, Local Polynomial Modelling and Its Applications, 1996.
//! - \[GKDS12\] I. Georgiev et al., Light Transport Simulation with Vertex Connection and Merging, ACM TOG 31(6), 2012.
//! - \[Haines19\] E. Haines, J. Günther, T. Akenine-Möller, Precision Improvements for Ray/Sphere Intersection, Ray
//!   Tracing Gems, 2019.
//! - \[Jensen96\] H. W. Jensen, Global Illumination using Photon Maps, EGWR 1996.
//! - \[JoeKuo08\] S. Joe, F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci.
//!   Comput. 30, 2008.
//! - \[KD13\] A. Kaplanyan, C. Dachsbacher, Adaptive Progressive Photon Mapping, ACM TOG 32(2), 2013.
//! - \[KZ11\] C. Knaus, M. Zwicker, Progressive Photon Mapping: A Probabilistic Approach, ACM TOG 30(3), 2011.
//! - \[LafortuneWillems94\] E. Lafortune, Y. Willems, Using the Modified Phong Reflectance Model for Physically Based
//!   Rendering, KU Leuven CW 197, 1994.
//! - \[LaineKarras11\] S. Laine, T. Karras, Stratified Sampling for Stochastic Transparency, EGSR 2011.
//! - \[Mitchell96\] D. P. Mitchell, Consequences of Stratified Sampling in Graphics, SIGGRAPH 1996.
//! - \[Neyman34\] J. Neyman, On the Two Different Aspects of the Representative Method, J. Royal Statistical Society 97(4),
//!   1934.
//! - \[Owen97\] A. B. Owen, Scrambled Net Variance for Integrals of Smooth Functions, Annals of Statistics 25(4), 1997.
//! - \[Reinhard02\] E. Reinhard et al., Photographic Tone Reproduction for Digital Images, SIGGRAPH 2002.
//! - \[ShirleyChiu97\] P. Shirley, K. Chiu, A Low Distortion Map Between Disk and Square, JGT 2(3), 1997.
//! - \[Ward88\] G. Ward, F. Rubinstein, R. Clear, A Ray Tracing Solution for Diffuse Interreflection, SIGGRAPH 1988.
//! - \[Veach97\] E. Veach, Robust Monte Carlo Methods for Light Transport Simulation, Stanford, 1997.

#[cfg(feature = "gui")]
pub mod app;
pub mod cli;
pub mod engine;
pub mod file;
pub mod film;
pub mod geometry;
pub mod math;
pub mod scene;
pub mod transport;
pub mod world;
