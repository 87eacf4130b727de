use thiserror::Error;

/// Why a scene cannot be rendered.
#[derive(Debug, Error, PartialEq)]
pub enum PrepareError {
    /// A texture file is missing or damaged.
    #[error("texture {0}")]
    Texture(String),
    /// A reference to a texture or a material that the scene does not have.
    #[error("{user} refers to {kind} `{name}`, which does not exist")]
    UnknownName {
        /// The object or material with the reference.
        user: String,
        /// "texture" or "material".
        kind: &'static str,
        /// The name in the reference.
        name: String,
    },
}
