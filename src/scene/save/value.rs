use crate::{
    geometry::bezier::ControlNet,
    math::Rgb,
    scene::{Color, Encoding, TextureUse, ToneCurve, UvRect},
};
use glam::{DVec2, DVec3};

/// A type that can be the value of a key.
pub(super) trait Value {
    /// The TOML text that reads as this value.
    fn toml(&self) -> String;
}

/// The text of a scene file so far.
#[derive(Default)]
pub(super) struct Text(String);

impl Text {
    /// Begins a table after an empty line.
    pub(super) fn table(&mut self, header: &str) {
        self.0 += &format!("\n{header}\n");
    }

    /// A line `key = value`.
    pub(super) fn key(&mut self, key: &str, value: &dyn Value) {
        self.0 += &format!("{key} = {}\n", value.toml());
    }

    /// A line `key = { a = 1, b = 2 }`.
    pub(super) fn inline(&mut self, key: &str, entries: &[(&str, &dyn Value)]) {
        self.0 += &format!("{key} = {}\n", inline(entries));
    }

    /// A list with each item on its own lines.
    pub(super) fn list(&mut self, key: &str, items: impl Iterator<Item = String>) {
        self.0 += &format!("{key} = [\n");
        items.for_each(|item| self.0 += &format!("  {item},\n"));
        self.0 += "]\n";
    }

    pub(super) fn finish(self) -> String {
        self.0
    }
}

fn inline(entries: &[(&str, &dyn Value)]) -> String {
    let entries: Vec<_> = entries.iter().map(|(key, value)| format!("{key} = {}", value.toml())).collect();
    format!("{{ {} }}", entries.join(", "))
}

/// The TOML text of a control net, one line per row.
pub(super) fn net(net: &ControlNet) -> String {
    let rows = net.points.map(|row| format!("[{}]", row.map(|p| p.toml()).join(", ")));
    format!("[ {} ]", rows.join(",\n    "))
}

// Debug prints the shortest decimal that reads as the same number, with the point or exponent that TOML requires.
impl Value for f64 {
    fn toml(&self) -> String {
        format!("{self:?}")
    }
}

impl Value for bool {
    fn toml(&self) -> String {
        self.to_string()
    }
}

impl Value for i32 {
    fn toml(&self) -> String {
        self.to_string()
    }
}

impl Value for u32 {
    fn toml(&self) -> String {
        self.to_string()
    }
}

impl Value for &str {
    fn toml(&self) -> String {
        toml::Value::from(*self).to_string()
    }
}

impl Value for String {
    fn toml(&self) -> String {
        self.as_str().toml()
    }
}

impl Value for DVec2 {
    fn toml(&self) -> String {
        format!("{:?}", self.to_array())
    }
}

impl Value for DVec3 {
    fn toml(&self) -> String {
        format!("{:?}", self.to_array())
    }
}

impl Value for UvRect {
    fn toml(&self) -> String {
        format!("{:?}", [self.start.x, self.start.y, self.end.x, self.end.y])
    }
}

impl Value for Rgb {
    fn toml(&self) -> String {
        format!("{:?}", self.to_array())
    }
}

impl Value for ToneCurve {
    fn toml(&self) -> String {
        match self {
            Self::Srgb => "srgb".toml(),
            Self::Filmic => "filmic".toml(),
        }
    }
}

impl Value for Encoding {
    fn toml(&self) -> String {
        match self {
            Self::Srgb => "srgb".toml(),
            Self::Linear => "linear".toml(),
        }
    }
}

impl Value for Color {
    fn toml(&self) -> String {
        match self {
            Self::Constant(c) => c.toml(),
            Self::Texture(TextureUse { texture, scale }) => inline(&[("texture", texture), ("scale", scale)]),
        }
    }
}
