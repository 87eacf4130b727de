use include_dir::{Dir, include_dir};

static SCENES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/scenes");
static ASSETS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets");

/// A scene inside the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltInScene {
    /// The name of its file without `.toml`.
    pub name: &'static str,
    /// The title in a menu.
    pub title: &'static str,
}

/// The scenes inside the program, in the order of a menu. The first is the default scene.
pub const fn built_in_scenes() -> &'static [BuiltInScene] {
    const fn scene(name: &'static str, title: &'static str) -> BuiltInScene {
        BuiltInScene { name, title }
    }
    &const {
        [
            scene("report", "Room with a sheet and two balls"),
            scene("report-flipped", "The same room, the sheet turned over"),
            scene("water", "Pool under one patch of water"),
            scene("cardioid", "Bent mirror and its cusp"),
            scene("lens", "Glass lens of patches"),
            scene("teapot", "Newell's teapot"),
            scene("cornell", "Diffuse box"),
        ]
    }
}

/// The bytes of a file inside the program, by its path in the project, like `assets/textures/a.png`; `None` if there is no
/// such file.
pub(super) fn embedded(path: &str) -> Option<&'static [u8]> {
    let (folder, rest) = path.split_once('/')?;
    let files = match folder {
        "scenes" => &SCENES,
        "assets" => &ASSETS,
        _ => return None,
    };
    files.get_file(rest).map(|file| file.contents())
}
