//! A number that tells scenes apart.

use super::{Film, SceneFile, Shape, save};

impl SceneFile {
    /// A number that is equal for scenes with the same light: it leaves out the title, the names of files, and the size, the exposure and
    /// the tone curve of the picture. Scenes with another light have another number, but for one chance in 2^64.
    ///
    /// # Errors
    ///
    /// A message, if a texture cannot be read.
    pub fn fingerprint(&self) -> Result<u64, String> {
        let mut scene = self.scene.clone();
        scene.name.clear();
        scene.film = Film::default();
        let mut files = Vec::new();
        for texture in &mut scene.textures {
            let bytes = self.location.read(&texture.file);
            files.push(bytes.map_err(|e| format!("\"{}\" cannot be read: {e}", texture.file))?);
            texture.file.clear();
        }
        for object in &mut scene.objects {
            if let Shape::Bezier(bezier) = &mut object.shape {
                bezier.file = None;
            }
        }
        let text = save::text(&scene);
        let parts = files.iter().map(|file| &file[..]).chain([text.as_bytes()]);
        Ok(parts.fold(FNV_OFFSET, |hash, part| fnv(fnv(hash, &part.len().to_le_bytes()), part)))
    }
}

const FNV_OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0100_0000_01b3;

/// The FNV-1a hash of bytes after the bytes with this hash. The hash of the standard library may change with its version.
fn fnv(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(FNV_PRIME))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::ToneCurve;

    #[test]
    fn the_hash_is_fnv() {
        assert_eq!(fnv(FNV_OFFSET, b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn only_light_matters() {
        let report = SceneFile::built_in("report").unwrap();
        let fingerprint = report.fingerprint().unwrap();
        let mut same = report.clone();
        same.scene.name = "another".to_owned();
        same.scene.film = Film { width: 7, height: 9, exposure: 2.0, tone_curve: ToneCurve::Filmic };
        assert_eq!(same.fingerprint().unwrap(), fingerprint);
        let mut brighter = report.clone();
        brighter.scene.render.max_bounces += 1;
        assert_ne!(brighter.fingerprint().unwrap(), fingerprint);
        let mut other_file = report;
        let (first, last) = (other_file.scene.textures[0].file.clone(), other_file.scene.textures.len() - 1);
        assert!(last > 0, "two textures");
        other_file.scene.textures[last].file = first;
        assert_ne!(other_file.fingerprint().unwrap(), fingerprint);
    }
}
