use include_dir::{Dir, include_dir};

static SCENES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/scenes");
static ASSETS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets");

/// A scene that the program carries with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltInScene {
    /// Its file's name without `.toml`.
    pub name: &'static str,
    /// For a menu.
    pub title: &'static str,
}

/// The scenes that the program carries with it, in the order of a menu; the first is the one to begin with.
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

/// The bytes of a file that the program carries with it, by its path in the project, like `assets/textures/a.png`.
pub(super) fn embedded(path: &str) -> Option<&'static [u8]> {
    let (folder, rest) = path.split_once('/')?;
    let files = match folder {
        "scenes" => &SCENES,
        "assets" => &ASSETS,
        _ => return None,
    };
    files.get_file(rest).map(|file| file.contents())
}
