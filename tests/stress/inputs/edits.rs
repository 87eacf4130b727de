//! Random edits of a file: bytes, ranges, words and numbers.

use proptest::{collection::vec, prelude::*, sample::Index, sample::select};

/// One edit of a file. An index counts from the beginning, whatever the length of the file is by then.
#[derive(Clone, Debug)]
enum Edit {
    /// Another byte.
    Byte(Index, u8),
    /// Bytes removed from one index on.
    Remove(Index, usize),
    /// Bytes from one index on, inserted at another one.
    Repeat(Index, usize, Index),
    /// A word inserted.
    Insert(Index, &'static str),
    /// The number after an index replaced.
    Number(Index, &'static str),
    /// The rest cut off.
    Truncate(Index),
}

/// Words of scene files and of other texts, some of them misplaced.
const WORDS: [&str; 22] = [
    "[[object]]\n",
    "[[material]]\n",
    "[camera]\n",
    "type = \"quad\"\n",
    "name = \"ball\"\n",
    "= ",
    "[",
    "]",
    "{",
    "}",
    "\"",
    "\n",
    "\r",
    "#",
    ",",
    "nan",
    "inf",
    "-",
    "\u{feff}",
    "\u{0}",
    "3 3\n",
    "[[[[",
];

/// Numbers at the limits of types and formats.
pub(super) const NUMBERS: [&str; 22] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "1e-9",
    "1e9",
    "-1e9",
    "1e30",
    "1e-30",
    "1e300",
    "-1e300",
    "5e-324",
    "1.7976931348623157e308",
    "1e999",
    "nan",
    "-inf",
    "4294967296",
    "9223372036854775807",
    "99999999999999999999",
    "0.1",
    "255",
    "16385",
];

fn edit() -> impl Strategy<Value = Edit> {
    let index = any::<Index>;
    prop_oneof![
        2 => (index(), any::<u8>()).prop_map(|(at, byte)| Edit::Byte(at, byte)),
        1 => (index(), 1usize..40).prop_map(|(at, length)| Edit::Remove(at, length)),
        1 => (index(), 1usize..200, index()).prop_map(|(from, length, to)| Edit::Repeat(from, length, to)),
        2 => (index(), select(&WORDS[..])).prop_map(|(at, word)| Edit::Insert(at, word)),
        6 => (index(), select(&NUMBERS[..])).prop_map(|(at, number)| Edit::Number(at, number)),
        1 => index().prop_map(Edit::Truncate),
    ]
}

/// Files of the corpus after one to eight edits.
pub(super) fn edited(corpus: Vec<Vec<u8>>) -> BoxedStrategy<Vec<u8>> {
    let after = |(mut bytes, edits): (Vec<u8>, Vec<Edit>)| {
        edits.iter().for_each(|edit| edit.apply(&mut bytes));
        bytes
    };
    (select(corpus), vec(edit(), 1..8)).prop_map(after).boxed()
}

impl Edit {
    fn apply(&self, bytes: &mut Vec<u8>) {
        let place = |index: &Index, bytes: &Vec<u8>| index.index(bytes.len() + 1);
        let range = |start: usize, length: usize, bytes: &Vec<u8>| start..(start + length).min(bytes.len());
        match self {
            Self::Byte(at, byte) if !bytes.is_empty() => {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            Self::Byte(..) => {}
            Self::Remove(at, length) => drop(bytes.drain(range(place(at, bytes), *length, bytes))),
            Self::Repeat(from, length, to) => {
                let repeated = bytes[range(place(from, bytes), *length, bytes)].to_vec();
                let to = place(to, bytes);
                bytes.splice(to..to, repeated);
            }
            Self::Insert(at, word) => {
                let at = place(at, bytes);
                bytes.splice(at..at, word.bytes());
            }
            Self::Number(at, number) => {
                let is_of_number = |byte: &u8| byte.is_ascii_digit() || b"+-.eE".contains(byte);
                let from = place(at, bytes);
                if let Some(start) = bytes[from..].iter().position(u8::is_ascii_digit).map(|k| from + k) {
                    let length =
                        bytes[start..].iter().position(|byte| !is_of_number(byte)).unwrap_or(bytes.len() - start);
                    bytes.splice(start..start + length, number.bytes());
                }
            }
            Self::Truncate(at) => bytes.truncate(place(at, bytes)),
        }
    }
}
