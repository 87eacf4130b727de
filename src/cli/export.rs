use super::{CliError, args::ExportArguments};
use crate::{
    file::write_whole,
    geometry::bezier::{ControlNet, QuadMesh, write_bpt},
    scene::{Scene, SceneFile, Shape},
};

/// `patchlight export`: the Bezier patches of a scene where they stand in the world, as a mesh or as control points.
pub(super) fn export(arguments: &ExportArguments) -> Result<(), CliError> {
    let file = SceneFile::find(&arguments.scene)?;
    let (name, nets) = chosen(&file.scene, arguments.object.as_deref())?;
    let extension = arguments.output.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    let text = match extension.as_str() {
        "obj" => QuadMesh::new(&nets, arguments.steps.get()).to_obj(&name),
        "bpt" => write_bpt(&nets),
        _ => {
            let path = arguments.output.display();
            return Err(CliError::Usage(format!("{path}: a file that ends in .obj or .bpt can be written")));
        }
    };
    write_whole(&arguments.output, text.as_bytes())
        .map_err(|e| CliError::Failed(format!("{} cannot be written: {e}", arguments.output.display())))
}

/// The patches of the object with this name, or of all objects that have patches, in world space.
fn chosen(scene: &Scene, object: Option<&str>) -> Result<(String, Vec<ControlNet>), CliError> {
    let mut names = Vec::new();
    let mut nets = Vec::new();
    for candidate in &scene.objects {
        let Shape::Bezier(bezier) = &candidate.shape else { continue };
        names.push(candidate.name.as_str());
        if object.is_none_or(|name| name == candidate.name) {
            let world_from_object = bezier.transform.world_from_object();
            nets.extend(bezier.patches.iter().map(|net| net.transformed(&world_from_object)));
        }
    }
    match object {
        _ if names.is_empty() => Err(CliError::Usage("the scene has no object of Bezier patches".to_owned())),
        Some(name) if !names.contains(&name) => {
            let names = names.join(", ");
            Err(CliError::Usage(format!("no object of Bezier patches is called `{name}`; there are: {names}")))
        }
        Some(name) => Ok((name.to_owned(), nets)),
        None => Ok((names.join("+"), nets)),
    }
}
