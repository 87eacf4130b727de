use super::{CliError, args::CheckArguments, rendering::pool, words::counted};
use crate::{
    engine::{PlanSummary, Session},
    scene::{Location, Scene, SceneFile},
};
use std::io::{Write, stdout};

/// `patchlight check`: prints the contents of a scene and the plan of its rendering.
pub(super) fn check(arguments: &CheckArguments) -> Result<(), CliError> {
    let file = SceneFile::find(&arguments.scene)?;
    let session = pool(None)?.install(|| Session::prepare(&file, 0, None))?;
    let label = match file.location {
        // The patches of a .bpt file.
        Location::Unsaved => arguments.scene.display().to_string(),
        _ => file.location.label(),
    };
    stdout().lock().write_all(text(&label, &file.scene, session.plan()).as_bytes())?;
    Ok(())
}

fn text(label: &str, scene: &Scene, plan: &PlanSummary) -> String {
    let mut text = format!("{label}: valid; {}\n", contents(scene));
    for note in &plan.notes {
        let verdict = if note.rendered { "rendered" } else { "skipped " };
        text += &format!("{verdict}  {}: {}\n", note.item, note.reason);
    }
    for warning in &plan.warnings {
        text += &format!("warning   {} {}; {}\n", warning.subject, warning.fault, warning.remedy);
    }
    text
}

fn contents(scene: &Scene) -> String {
    let patches = scene.objects.iter().map(|o| o.shape.surface().map_or(0, |surface| surface.patches.len()));
    let counts = [
        (scene.objects.len(), "object"),
        (patches.sum(), "Bezier patch"),
        (scene.lights.len(), "light"),
        (scene.materials.len(), "material"),
        (scene.textures.len(), "texture"),
    ];
    counts.map(|(n, word)| counted(n as u64, word)).join(", ")
}
