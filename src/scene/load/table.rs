use super::{field::Field, notes::Notes};
use crate::scene::problem::suggestion;
use toml::{Spanned, de::DeTable};

/// A TOML table that records the keys that are read; all other keys are unknown.
pub(super) struct Table<'a> {
    entries: &'a DeTable<'a>,
    path: String,
    known: Vec<&'static str>,
    accepts_all: bool,
    notes: &'a mut Notes,
}

impl<'a> Table<'a> {
    pub(super) fn new(entries: &'a DeTable<'a>, path: &str, notes: &'a mut Notes) -> Self {
        Self { entries, path: path.to_owned(), known: Vec::new(), accepts_all: false, notes }
    }

    /// The value of `key`. Reports a problem and returns `fallback` if it is missing or invalid.
    pub(super) fn required<T: Field>(&mut self, key: &'static str, fallback: T) -> T {
        if !self.has(key) {
            self.add(format!("the key `{key}` is missing, expected {}", T::EXPECTED));
        }
        self.optional(key, fallback)
    }

    /// The value of `key`, or `default` if it is missing. Reports a problem and returns `default` if it is invalid.
    pub(super) fn optional<T: Field>(&mut self, key: &'static str, default: T) -> T {
        self.maybe(key).unwrap_or(default)
    }

    /// The value of `key`; `None` if it is missing, or after reporting a problem if it is invalid.
    pub(super) fn maybe<T: Field>(&mut self, key: &'static str) -> Option<T> {
        self.known.push(key);
        let value = self.entries.get(key)?;
        let path = self.path_of(key);
        self.notes.mark(&path, value.span());
        T::read(value.get_ref(), &path, self.notes)
    }

    /// Whether the table has this key.
    pub(super) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    /// Reports a problem with the table as a whole.
    pub(super) fn add(&mut self, message: String) {
        self.notes.add(&self.path, message);
    }

    /// Reports a problem with one key.
    pub(super) fn add_at(&mut self, key: &str, message: String) {
        let path = self.path_of(key);
        self.notes.add(&path, message);
    }

    /// Accepts all keys: for a table of unknown type, whose keys are unknown too.
    pub(super) fn accept_all(&mut self) {
        self.accepts_all = true;
    }

    /// Reports the unknown keys.
    pub(super) fn finish(self) {
        if self.accepts_all {
            return;
        }
        let unknown = self.entries.iter().filter(|(key, _)| !self.known.contains(&key.get_ref().as_ref()));
        for (key, _) in unknown {
            let name: &str = key.get_ref();
            let path = join(&self.path, name);
            self.notes.mark(&path, Spanned::span(key));
            let hint = suggestion(name, self.known.iter().copied());
            self.notes.add(&path, format!("unknown key, expected one of {}{hint}", self.known.join(", ")));
        }
    }

    fn path_of(&self, key: &str) -> String {
        join(&self.path, key)
    }
}

fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}
