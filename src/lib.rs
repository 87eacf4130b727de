//! patchlight shows what light does with a curved surface: a progressive photon mapper for scenes of bicubic Bezier
//! patches, spheres and planes. A window shows a scene; the user drags a control point, a light or a material, and the
//! caustics form again at once; left alone, the picture converges.
//!
//! This page is the architecture. The method with its equations is on one page, `docs/method.md` in the repository.
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
//!                                                             |   Plan: items to render, items to skip, reasons
//!                                                             |        ▼
//!                                                             |   a draft, never cancelled, then finer drafts, then 1, 2, ...
//!                                                             |   ┌─ iteration i ───────────────────────────────┐
//!                                                             |   │ photon passes ─► sheets, photons, splats    │
//!                                                             |   │ photon maps   ─► four kd-trees              │
//!                                                             |   │ in bands of rows:                           │
//!                                                             |   │   camera pass ─► visible points, samples    │
//!                                                             |   │   gather pass ─► radiance at visible points │
//!                                                             |   │ contribution  ─► bands, splats, lobe reuse  │
//!                                                             |   │ commit        ─► film sums, statistics      │
//!                                                             |   │   after 4, 8, ...: the plan is refined      │
//!                                                             |   └──────────────────┬──────────────────────────┘
//!    newest frame only, never an older generation ◄───────────┼── Frame { generation, iteration, image, stats }
//!       ▼                                                     |
//!    exposure, tone curve ─► texture ─► canvas ─► handles     |
//! ```
//!
//! The photon passes come first so that the camera pass and the gather pass can go through the film in bands: memory for
//! visible points does not grow with the picture. `patchlight render` and `bench` run an [`engine::Session`], which renders
//! the same iterations on the caller's thread.
//!
//! # Example
//!
//! Renders a scene to a PNG file.
//!
//! ```
//! use patchlight::engine::Session;
//! use patchlight::film::{PngDepth, Provenance, ToneMap, write_png};
//! use patchlight::math::Rgb;
//! use patchlight::scene::SceneFile;
//! use patchlight::transport::Cancel;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut file = SceneFile::built_in("water")?;
//! (file.scene.film.width, file.scene.film.height) = (48, 32);
//! let seed = 1;
//! let mut session = Session::prepare(&file, seed, None)?;
//! for _ in 0..3 {
//!     session.advance(Cancel::NEVER);
//! }
//! let image = session.frame(0).image;
//! assert!(image.pixels.iter().any(|&pixel| pixel != Rgb::ZERO));
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("water.png");
//! let film = &file.scene.film;
//! let tone = ToneMap::new(film.exposure, film.tone_curve);
//! write_png(&path, &image, &tone, PngDepth::Eight, &Provenance::default())?;
//! assert!(path.metadata()?.len() > 0);
//! # Ok(())
//! # }
//! ```
//!
//! # Modules
//!
//! A module uses only modules above it in this list.
//!
//! | module | holds | never knows |
//! |---|---|---|
//! | [`mod@file`] | writing a file whole or not at all | the content of the file |
//! | [`math`] | rays, boxes, orthonormal bases, error bounds, sampling warps, index-based random streams | colour, scenes, time |
//! | [`geometry`] | sphere, quad, plane, [`geometry::bezier`], the tree over primitives | materials, files, threads |
//! | [`scene`] | the description by the user: plain data; load, save, validate | trees, images, rendering, windows |
//! | [`world`] | the data of the renderer, prepared from a scene, immutable | passes, windows |
//! | [`film`] | linear images, tone curves, PNG and EXR, error metrics | rendering |
//! | [`transport`] | scattering, the plan, the passes, the photon map, the schedule | channels, clocks, files |
//! | [`engine`] | the worker, film sums, commands in, frames out, cancel, restart | windows, how surfaces scatter |
//! | [`cli`], `app` | the two front ends, side by side | each other |
//!
//! # Rules
//!
//! - A pass is a function of its arguments. A random number depends on (seed, stream, sequence, index, dimension) alone; the
//!   index of a pixel's or a light's sequence runs on through all iterations. One thread and many give the same bits.
//! - An iteration is a pure function of (world, plan, seed, i), so films of consecutive iterations can be merged. A
//!   fixed schedule sets the size of an iteration, which weights its photons in the mean. The number of samples that
//!   the neighbouring pixels need weights its camera samples. After iterations 4, 8, 16, ... the plan is refined by the
//!   measurements of the iterations: radii of density estimates, pixels that gather caustics, and the number of camera
//!   samples of each pixel.
//! - A cancelled pass returns nothing, and the film changes only by whole iterations. Drafts, the picture before an
//!   edit and smoothed pictures never enter the film.
//! - Colours are `f32`; positions, directions and distances are `f64`, because the offset that keeps a ray off the surface
//!   it leaves has to be small against the scene and large against rounding. Photons and visible points are stored in `f32`,
//!   relative to the middle of the scene.
//! - Only finite values enter the film; dropped values are counted and shown.
//! - Every path of light counts once: one technique finds it, or MIS weights divide it among several techniques.
//!
//! # Glossary
//!
//! Light and paths:
//!
//! | word | meaning |
//! |---|---|
//! | path, vertex | light's way between a light and the camera; a scattering event on it |
//! | throughput | fraction of the light entering at a path's end that reaches its start (beta in papers) |
//! | `wi`, `wo` | unit directions away from a surface: towards where light comes from, and where it goes |
//! | `n_geom`, `n_side`, `n_shade` | unit normal of a surface's front; of the side that the path is on; on that side, perturbed by a normal or height map |
//! | `eta` | index of refraction behind an interface over the index in front of it |
//! | specular, glossy | scattering into one direction by a mirror or glass; into a Phong lobe |
//! | light sheet, signature | the light of a lamp that goes by one sequence of mirrors and glass, as cells on the surface where it lands; that sequence |
//! | light path, landing place | the way of light from a lamp over mirrors and glass, as the window draws it; where it meets a surface that scatters it |
//! | component | direct light (with emission), caustics or interreflection: every path of light belongs to one of them |
//! | caustic | light that met only mirrors or glass between the light and the visible point |
//! | indirect caustic | light that mirrors or glass send on after a diffuse or glossy surface scattered it |
//! | interreflection | light that diffuse or glossy surfaces scattered at least twice |
//! | visible point | point of a diffuse or glossy surface that a camera path reaches, and where photons are gathered |
//! | facet | shading normal and albedo at one camera sample of a pixel on a surface with relief |
//! | viewing lobe | last Phong lobe through which a camera path sees a point |
//! | sun, beam | lights of parallel rays: from outside the scene, within a cone of directions; from a disc |
//! | light importance | fraction of a light's photon paths that reach points that the camera may see |
//!
//! Photons and density estimates:
//!
//! | word | meaning |
//! |---|---|
//! | photon | flux that arrived at a point of a surface, with its direction |
//! | photon map | kd-tree over photons; an iteration has four: for caustics, interreflection, indirect caustics and Phong lobes |
//! | projection map | density over the first rays of a light (directions; for parallel rays, points across them) that aims photons at mirrors and glass, or at a scene that appears small |
//! | chart | map from the unit square to the first rays of a light, on which a projection map is a density; keeps areas |
//! | splat | flux of a caustic photon added to the pixel that sees it, without a density estimate (light tracing) |
//! | density estimate | kernel-weighted sum of the flux of photons in a disc, over the kernel's integral: irradiance or radiance |
//! | footprint | side of a pixel projected to the distance of a point, scene units |
//! | clearance | distance from a visible point to the nearest other object, scene units; limits the radius |
//! | visibility polygon | region of a plane that is visible from a point of the plane, past objects standing on it |
//! | cosine correction | factor of a photon's flux: the cosine at the gathering point over the cosine where the photon arrived |
//! | bandwidth | radii of density estimates over the film, relative to the radii after one full iteration |
//! | bandwidth difference | change of a density estimate in a disc 1.5 times as wide; tells its bias |
//! | interleaved sampling | one pixel of each square of 2 x 2 gathers irradiance for its neighbours; the pixel changes with the iteration |
//! | lobe reuse | each pixel takes the mean over its neighbours' samples of a Phong lobe |
//! | MIS weight | weight of a technique for a path of light that several techniques can find; the weights add up to 1 |
//!
//! Iterations and the film:
//!
//! | word | meaning |
//! |---|---|
//! | iteration, pass | one full round of the algorithm; one stage of a round |
//! | size of an iteration | its number of photon paths over the number of a full iteration; 1/8, 1/4, 1/2, then 1 |
//! | plan | the settings of every pass for a scene: paths, radii, samples; new, draft, refined, or for only one component |
//! | run | all iterations of one scene, size and seed; each has its number |
//! | part | consecutive iterations of a run, with their measurements; parts can be merged |
//! | kept plan | plan that no later measurement refines, so that parts of a run need no measurements of other parts |
//! | checkpoint | a part in a file |
//! | draft | quick first picture after an edit, with fewer pixels and photons |
//! | stand-in | picture before an edit, which the screen shows where the edit has hardly changed the light, times the change |
//! | display filter, smoothed | takes noise out of the interreflection that the screen shows; what it was taken out of |
//! | block | 2 x 2 pixels whose irradiance the display filter smooths together |
//! | preview | picture for the screen alone: smoothed, and together with the stand-in |
//! | generation | number of a scene that the engine was sent; grows with each edit |
//! | band | whole rows of the film that the camera pass and the gather pass render independently |
//! | heterogeneous pixel | pixel that shows several surfaces or a texture; gets at least four camera samples |
//! | convergence rate | power of the number of samples with which the variance of their mean falls |
//! | unseen light | bound of the light that a component may lack because no photon path has brought it yet; part of the error estimate |
//! | warning | fault of a scene that can be rendered, such as open glass; with its effect on the picture and a remedy |
//!
//! Surfaces:
//!
//! | word | meaning |
//! |---|---|
//! | patch, control net | a bicubic Bezier surface; its 4 x 4 control points |
//! | surface of revolution, profile | the patches that a curve sweeps around an axis; that curve, cubic Bezier segments in (r, y) |
//! | `dpdu`, `dpdv` | derivatives of the position by the parameters u and v |
//! | subpatch | nearly flat piece of a patch over a rectangle of its parameters: a leaf's item in the tree of the patch |
//! | unit space | coordinates of a patch in which its box has a diagonal of 1/2 to 1 |
//! | ray packet | eight rays that traverse a tree together, a ray in each SIMD lane |
//! | lane | slot of a SIMD vector; a vector has eight |
//!
//! Bodies of glass:
//!
//! | word | meaning |
//! |---|---|
//! | body | one piece of glass: the surfaces of the objects with one `body`, or of one glass material |
//! | priority | number of a glass material: where bodies overlap, the medium of the body with the highest priority applies |
//! | rank | place of a body in the order by priority, then smaller bounding box, then later place in the file |
//! | media | ranks of all bodies around a point of a path; the medium of the highest rank applies |
//! | contact | coincidence of a surface of glass with other surfaces; a path crosses all of them at once |
//!
//! # References
//!
//! - \[Andersson20\] P. Andersson et al., FLIP: A Difference Evaluator for Alternating Images, HPG 2020.
//! - \[Arvo95\] J. Arvo, Stratified Sampling of Spherical Triangles, SIGGRAPH 1995.
//! - \[Blinn78\] J. Blinn, Simulation of Wrinkled Surfaces, SIGGRAPH 1978.
//! - \[Burley20\] B. Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020.
//! - \[Clarberg08\] P. Clarberg, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD, JGT 13(3), 2008.
//! - \[Dammertz10\] H. Dammertz et al., Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering, HPG 2010.
//! - \[DowellJarratt71\] M. Dowell, P. Jarratt, A Modified Regula Falsi Method for Computing the Root of an Equation, BIT 11, 1971.
//! - \[Duff17\] T. Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
//! - \[FanGijbels96\] J. Fan, I. Gijbels, Local Polynomial Modelling and Its Applications, 1996.
//! - \[GKDS12\] I. Georgiev et al., Light Transport Simulation with Vertex Connection and Merging, ACM TOG 31(6), 2012.
//! - \[Haines19\] E. Haines, J. Günther, T. Akenine-Möller, Precision Improvements for Ray/Sphere Intersection, Ray
//!   Tracing Gems, 2019.
//! - \[HanleyLippman83\] J. A. Hanley, A. Lippman-Hand, If Nothing Goes Wrong, Is Everything All Right?, JAMA 249(13), 1983.
//! - \[HJ09\] T. Hachisuka, H. W. Jensen, Stochastic Progressive Photon Mapping, ACM TOG 28(5), 2009.
//! - \[HOJ08\] T. Hachisuka, S. Ogaki, H. W. Jensen, Progressive Photon Mapping, ACM TOG 27(5), 2008.
//! - \[Jensen96\] H. W. Jensen, Global Illumination using Photon Maps, EGWR 1996.
//! - \[JoeKuo08\] S. Joe, F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci.
//!   Comput. 30, 2008.
//! - \[JonesFoster96\] M. C. Jones, P. J. Foster, A Simple Nonnegative Boundary Correction Method for Kernel Density Estimation, Statistica
//!   Sinica 6, 1996.
//! - \[KamelFaloutsos93\] I. Kamel, C. Faloutsos, On Packing R-trees, CIKM 1993.
//! - \[KD13\] A. Kaplanyan, C. Dachsbacher, Adaptive Progressive Photon Mapping, ACM TOG 32(2), 2013.
//! - \[KellerHeidrich01\] A. Keller, W. Heidrich, Interleaved Sampling, EGWR 2001.
//! - \[Kopf07\] J. Kopf et al., Joint Bilateral Upsampling, ACM TOG 26(3), 2007.
//! - \[KZ11\] C. Knaus, M. Zwicker, Progressive Photon Mapping: A Probabilistic Approach, ACM TOG 30(3), 2011.
//! - \[LafortuneWillems94\] E. Lafortune, Y. Willems, Using the Modified Phong Reflectance Model for Physically Based
//!   Rendering, KU Leuven CW 197, 1994.
//! - \[LaineKarras11\] S. Laine, T. Karras, Stratified Sampling for Stochastic Transparency, EGSR 2011.
//! - \[LorensenCline87\] W. E. Lorensen, H. E. Cline, Marching Cubes: A High Resolution 3D Surface Construction Algorithm, SIGGRAPH 1987.
//! - \[Mitchell96\] D. P. Mitchell, Consequences of Stratified Sampling in Graphics, SIGGRAPH 1996.
//! - \[Morton66\] G. M. Morton, A Computer Oriented Geodetic Data Base and a New Technique in File Sequencing, IBM 1966.
//! - \[Neyman34\] J. Neyman, On the Two Different Aspects of the Representative Method, J. Royal Statistical Society 97(4),
//!   1934.
//! - \[Owen97\] A. B. Owen, Scrambled Net Variance for Integrals of Smooth Functions, Annals of Statistics 25(4), 1997.
//! - \[Reinhard02\] E. Reinhard et al., Photographic Tone Reproduction for Digital Images, SIGGRAPH 2002.
//! - \[SaitoTakahashi90\] T. Saito, T. Takahashi, Comprehensible Rendering of 3-D Shapes, SIGGRAPH 1990.
//! - \[Schuessler17\] V. Schüßler et al., Microfacet-based Normal Mapping for Robust Monte Carlo Path Tracing, ACM TOG 36(6), 2017.
//! - \[Shoemake92\] K. Shoemake, Uniform Random Rotations, Graphics Gems III, 1992.
//! - \[ShirleyChiu97\] P. Shirley, K. Chiu, A Low Distortion Map Between Disk and Square, JGT 2(3), 1997.
//! - \[SutherlandHodgman74\] I. Sutherland, G. Hodgman, Reentrant Polygon Clipping, CACM 17(1), 1974.
//! - \[Umenhoffer08\] T. Umenhoffer, G. Patow, L. Szirmay-Kalos, Caustic Triangles on the GPU, CGI 2008.
//! - \[Ward88\] G. Ward, F. Rubinstein, R. Clear, A Ray Tracing Solution for Diffuse Interreflection, SIGGRAPH 1988.
//! - \[VanOosterom83\] A. Van Oosterom, J. Strackee, The Solid Angle of a Plane Triangle, IEEE Trans. Biomed. Eng. 30(2), 1983.
//! - \[Veach97\] E. Veach, Robust Monte Carlo Methods for Light Transport Simulation, Stanford, 1997.
//! - \[Watt90\] M. Watt, Light-Water Interaction Using Backward Beam Tracing, SIGGRAPH 1990.

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
