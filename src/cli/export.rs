use super::{
    CliError,
    args::ExportArguments,
    output::{must_not_overwrite, must_spare_files_of, write},
};
use crate::scene::{Scene, SceneFile, SurfaceExport, SurfaceFormat, SurfaceOptions};

/// `patchlight export`: writes the Bezier patches of a scene in world space, for another program.
pub(super) fn export(arguments: &ExportArguments) -> Result<(), CliError> {
    let file = SceneFile::find(&arguments.scene)?;
    let of_scene = |message: String| CliError::Usage(format!("{}: {message}", file.location.label()));
    let surface = chosen(&file.scene, arguments.object.as_deref()).map_err(of_scene)?;
    let path = arguments.output.display();
    let format = SurfaceFormat::of(&arguments.output).ok_or_else(|| {
        let names = SurfaceFormat::EXTENSIONS.map(|extension| format!(".{extension}")).join(", ");
        CliError::Usage(format!("{path}: expected a name that ends in one of {names}"))
    })?;
    if arguments.free_form && format != SurfaceFormat::Obj {
        return Err(CliError::Usage(format!("{path}: --free-form is for .obj alone")));
    }
    must_not_overwrite(&arguments.output, [(arguments.scene.as_path(), "the scene")])?;
    must_spare_files_of(&file, &arguments.output)?;
    write(
        &arguments.output,
        &surface.bytes(format, SurfaceOptions { steps: arguments.steps, free_form: arguments.free_form }),
    )
}

/// The patches of the object with this name, or of all objects that have patches.
fn chosen(scene: &Scene, wanted: Option<&str>) -> Result<SurfaceExport, String> {
    let all = scene.objects.iter().filter(|object| object.shape.surface().is_some());
    let chosen = all.clone().filter(|object| wanted.is_none_or(|name| name == object.name));
    SurfaceExport::of(chosen).ok_or_else(|| {
        let names: Vec<_> = all.map(|object| object.name.as_str()).collect();
        match wanted.filter(|_| !names.is_empty()) {
            Some(name) => {
                let names = names.join(", ");
                format!("no object of Bezier patches has the name `{name}`; their names are {names}")
            }
            None => "the scene has no object of Bezier patches".to_owned(),
        }
    })
}
