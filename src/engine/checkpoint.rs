//! A part of a run in a file.
//!
//! | bytes | hold |
//! |--:|---|
//! | 8 | `PLFILM` and a line end, which programs that change line ends would damage |
//! | 4 | version of the format |
//! | 4 | length of the head |
//! | 8 | length of the body |
//! | 4 | checksum (CRC-32) of the body |
//! | 4 | checksum of all bytes before, and of the head |
//! | | the head: the run, its first and its last iteration |
//! | | the body: the part, and the text of the scene, compressed by DEFLATE |
//!
//! Numbers are little-endian. The head and the unpacked body are in the encoding of the crate `postcard`; sums keep all their bits.

use super::film_part::FilmPart;
use super::run::{MOST_TEXT, Run};
use crate::file::{open, write_whole};
use flate2::{Compression, Crc, read::DeflateDecoder, write::DeflateEncoder};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::fs::File;
use std::io::{self, BufWriter, ErrorKind, Read};
use std::path::{Path, PathBuf};
use thiserror::Error;

const MAGIC: [u8; 8] = *b"PLFILM\r\n";
const VERSION: u32 = 5;
/// Length of the fields before the head.
const FIELDS: usize = 32;
/// Most bytes of a head: the paths of systems have up to 4096 bytes.
const MAX_HEAD_BYTES: u32 = 1 << 16;
/// Most bytes of the unpacked body for each pixel: the largest part takes some 200.
const MAX_BYTES_PER_PIXEL: u64 = 512;
/// Most pixels along a side.
const MAX_SIDE: u32 = crate::scene::Film::MOST_PIXELS;

/// A part of a run, and the run.
#[derive(Clone, Debug)]
pub struct Checkpoint {
    /// The run that the part belongs to.
    pub run: Run,
    /// The part.
    pub part: FilmPart,
}

/// Why a checkpoint cannot be read or written.
#[derive(Debug, Error)]
pub enum CheckpointError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", file.display())]
    Read {
        /// The path of the file.
        file: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The file is no whole checkpoint.
    #[error("{}: {problem}", file.display())]
    Content {
        /// The path of the file.
        file: PathBuf,
        /// The problem, and what to do.
        problem: String,
    },
    /// The file cannot be written. The previous file is unchanged.
    #[error("{}: cannot be written: {source}", file.display())]
    Write {
        /// The path of the file.
        file: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
}

/// The start of a checkpoint, which tells whether to read the rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Head {
    run: Run,
    first: u64,
    last: u64,
}

/// A checkpoint of which only the head was read.
#[derive(Debug)]
pub struct CheckpointFile {
    path: PathBuf,
    head: Head,
    body: File,
    body_length: u64,
    body_checksum: u32,
}

impl Checkpoint {
    /// Writes a part of a run to a file, whole or not at all.
    ///
    /// # Errors
    ///
    /// If the file cannot be written; the previous file is then unchanged.
    pub fn write(path: &Path, run: &Run, part: &FilmPart) -> Result<(), CheckpointError> {
        let written = encoded(run, part).and_then(|bytes| write_whole(path, &bytes));
        written.map_err(|source| CheckpointError::Write { file: path.to_owned(), source })
    }
}

impl CheckpointFile {
    /// Opens a checkpoint and reads its head.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, or does not begin as a whole checkpoint does.
    pub fn open(path: &Path) -> Result<Self, CheckpointError> {
        let failed = |source| CheckpointError::Read { file: path.to_owned(), source };
        let mut file = open(path).map_err(failed)?;
        let length = file.metadata().map_err(failed)?.len();
        let mut fields = [0; FIELDS];
        read_exact(&mut file, &mut fields, path)?;
        let field = |at: usize| fields[at..at + 4].try_into().map_or(0, u32::from_le_bytes);
        if fields[..8] != MAGIC {
            return Err(content(path, "is no checkpoint of patchlight"));
        }
        if field(8) != VERSION {
            let problem = format!("has format {}, this version of patchlight reads format {VERSION}", field(8));
            return Err(content(path, &problem));
        }
        let (head_length, body_length) = (field(12), fields[16..24].try_into().map_or(0, u64::from_le_bytes));
        let stated = body_length.checked_add(FIELDS as u64 + u64::from(head_length));
        if head_length > MAX_HEAD_BYTES || stated != Some(length) {
            return Err(damaged(path, "its length is not the one that it states"));
        }
        let mut head = vec![0; head_length as usize];
        read_exact(&mut file, &mut head, path)?;
        let is_whole = field(28) == checksum(&[&fields[..28], &head]);
        let head = is_whole.then(|| decoded(&head)).flatten().filter(|head: &Head| {
            let (width, height) = head.run.size();
            width.min(height) > 0 && width.max(height) <= MAX_SIDE
        });
        let head = head.ok_or_else(|| damaged(path, "its head has changed"))?;
        Ok(Self { path: path.to_owned(), head, body: file, body_length, body_checksum: field(24) })
    }

    /// The run that the part belongs to.
    pub fn run(&self) -> &Run {
        &self.head.run
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The numbers, in the run, of the first and the last iteration of the part's film.
    pub fn iterations(&self) -> (u64, u64) {
        (self.head.first, self.head.last)
    }

    /// Reads the rest.
    ///
    /// # Errors
    ///
    /// If the file cannot be read or is damaged.
    pub fn read(self) -> Result<Checkpoint, CheckpointError> {
        let (width, height) = self.head.run.size();
        let limit = MAX_BYTES_PER_PIXEL * u64::from(width + 1) * u64::from(height + 1) + MOST_TEXT as u64;
        let path = &self.path;
        if self.body_length > limit {
            return Err(damaged(path, "it is too long for its film"));
        }
        let mut packed = Vec::new();
        let read = self.body.take(limit).read_to_end(&mut packed);
        read.map_err(|source| CheckpointError::Read { file: path.clone(), source })?;
        if packed.len() as u64 != self.body_length || checksum(&[&packed]) != self.body_checksum {
            return Err(damaged(path, "its checksum is wrong"));
        }
        let mut body = Vec::new();
        let unpacked = DeflateDecoder::new(&packed[..]).take(limit).read_to_end(&mut body);
        let read = unpacked.ok().and_then(|_| decoded(&body)).filter(|(part, _): &(FilmPart, Option<String>)| {
            (part.film().first(), part.film().last()) == (self.head.first, self.head.last) && part.fits(width, height)
        });
        let (part, text) = read.ok_or_else(|| damaged(path, "its parts contradict each other"))?;
        Ok(Checkpoint { run: self.head.run.with_text(text), part })
    }
}

/// The bytes of a checkpoint.
fn encoded(run: &Run, part: &FilmPart) -> io::Result<Vec<u8>> {
    let (first, last) = (part.film().first(), part.film().last());
    let head = postcard::to_allocvec(&Head { run: run.clone(), first, last }).map_err(io::Error::other)?;
    // Packed as it is encoded: both copies of a large film at once would take too much memory.
    let packing = BufWriter::new(DeflateEncoder::new(Vec::new(), Compression::fast()));
    let packing = postcard::to_io(&(part, &run.text), packing).map_err(io::Error::other)?;
    let packed = packing.into_inner().map_err(io::IntoInnerError::into_error)?.finish()?;
    let mut bytes = MAGIC.to_vec();
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend((head.len() as u32).to_le_bytes());
    bytes.extend((packed.len() as u64).to_le_bytes());
    bytes.extend(checksum(&[&packed]).to_le_bytes());
    bytes.extend(checksum(&[&bytes, &head]).to_le_bytes());
    bytes.extend(head);
    bytes.extend(packed);
    Ok(bytes)
}

/// The value that all these bytes encode.
fn decoded<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    postcard::take_from_bytes(bytes).ok().filter(|(_, rest)| rest.is_empty()).map(|(value, _)| value)
}

fn checksum(parts: &[&[u8]]) -> u32 {
    let mut checksum = Crc::new();
    parts.iter().for_each(|part| checksum.update(part));
    checksum.sum()
}

fn read_exact(file: &mut File, bytes: &mut [u8], path: &Path) -> Result<(), CheckpointError> {
    file.read_exact(bytes).map_err(|source| match source.kind() {
        ErrorKind::UnexpectedEof => damaged(path, "it ends within its head"),
        _ => CheckpointError::Read { file: path.to_owned(), source },
    })
}

fn content(path: &Path, problem: &str) -> CheckpointError {
    CheckpointError::Content { file: path.to_owned(), problem: problem.to_owned() }
}

fn damaged(path: &Path, how: &str) -> CheckpointError {
    content(path, &format!("is a damaged checkpoint: {how}; use an older copy, or render the iterations again"))
}
