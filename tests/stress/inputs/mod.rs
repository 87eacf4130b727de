//! Damaged and random files.
//!
//! | file | holds |
//! |---|---|
//! | `bodies` | what must hold of the bytes of a file of each kind; `fuzz/` has the same functions |
//! | `corpus` | valid files of each kind |
//! | `edits` | random edits of a file |
//! | `random_files` | random files that have the structure of their kind |

mod bodies;
mod corpus;
mod edits;
mod random_files;

use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestError, TestRng, TestRunner};

/// A kind of files with what must hold of each of them.
pub(crate) struct Kind {
    pub(crate) name: &'static str,
    body: fn(&[u8]),
    corpus: fn() -> Vec<Vec<u8>>,
    random: fn() -> BoxedStrategy<Vec<u8>>,
}

/// Every kind of file that the program reads.
pub(crate) const KINDS: [Kind; 6] = [
    Kind { name: "scenes", body: bodies::scene, corpus: corpus::scenes, random: random_files::scene },
    Kind { name: ".bpt files", body: bodies::patches, corpus: corpus::patches, random: random_files::patches },
    Kind { name: "textures", body: bodies::texture, corpus: corpus::textures, random: random_files::texture },
    Kind { name: "EXR files", body: bodies::exr, corpus: corpus::exrs, random: random_files::exr },
    Kind { name: "tables of rays", body: bodies::rays, corpus: corpus::rays, random: random_files::rays },
    Kind { name: "films", body: bodies::film, corpus: corpus::films, random: random_files::film },
];

impl Kind {
    /// Tries this many edited files. Returns 0, or 1 after the first failure, whose smallest file it prints.
    pub(crate) fn fails_edited(&self, files: u32, round: u64) -> u64 {
        self.fails(edits::edited((self.corpus)()), files, round)
    }

    /// Tries this many random files, as [`Kind::fails_edited`] does.
    pub(crate) fn fails_random(&self, files: u32, round: u64) -> u64 {
        self.fails((self.random)(), files, round)
    }

    fn fails(&self, strategy: BoxedStrategy<Vec<u8>>, files: u32, round: u64) -> u64 {
        let mut seed = [7; 32];
        seed[..8].copy_from_slice(&round.to_le_bytes());
        let config = Config { cases: files, failure_persistence: None, ..Config::default() };
        let mut runner = TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &seed));
        let tried = |bytes: Vec<u8>| {
            (self.body)(&bytes);
            Ok(())
        };
        match runner.run(&strategy, tried) {
            Ok(()) => 0,
            Err(TestError::Fail(reason, bytes)) => {
                eprintln!("{}: {reason}:\n{}", self.name, String::from_utf8_lossy(&bytes[..bytes.len().min(10_000)]));
                1
            }
            Err(TestError::Abort(reason)) => panic!("{}: {reason}", self.name),
        }
    }
}
