//! The words of a text with their lines.

use super::error::{FormatError, FormatProblem};

/// How a format separates words. White space and commas separate words in all formats.
#[derive(Clone, Copy, Debug)]
pub(super) struct Syntax {
    /// What begins a comment that ends with its line.
    pub(super) comment: &'static str,
    /// What begins and ends a comment over several lines; empty where there is none.
    pub(super) block_comment: [&'static str; 2],
    /// Characters that are words of their own.
    pub(super) symbols: &'static str,
}

/// Most words of a line that [`Scanner::words_of_next_line`] returns.
const MOST_WORDS_OF_LINE: usize = 32;

/// Reads a text word by word.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scanner<'a> {
    syntax: Syntax,
    rest: &'a str,
    /// The line at which the rest begins.
    next_line: usize,
    /// The line of the last word; at the end of the text, its last line.
    pub(super) line: usize,
}

impl<'a> Scanner<'a> {
    pub(super) fn new(text: &'a str, syntax: Syntax) -> Self {
        // Some editors begin a file with a byte order mark.
        Self { syntax, rest: text.trim_start_matches('\u{feff}'), next_line: 1, line: 1 }
    }

    /// The next word; `None` at the end. A text in quotes is one word, with the quotes.
    pub(super) fn next(&mut self) -> Option<&'a str> {
        self.skip_blanks();
        self.line = self.next_line;
        let first = self.rest.chars().next()?;
        let is_symbol = |c: char| self.syntax.symbols.contains(c);
        let length = if first == '"' {
            let end = self.rest[1..].find(['"', '\n']).map_or(self.rest.len(), |at| at + 2);
            end.min(self.rest.len())
        } else if is_symbol(first) {
            first.len_utf8()
        } else {
            let ends = |(at, c): (usize, char)| {
                let is_end = c.is_whitespace() || c == ',' || c == '"' || is_symbol(c) || self.begins_comment(at);
                is_end.then_some(at)
            };
            self.rest.char_indices().skip(1).find_map(ends).unwrap_or(self.rest.len())
        };
        Some(self.take(length))
    }

    /// The next word, which remains to be read.
    pub(super) fn peek(&self) -> Option<&'a str> {
        { *self }.next()
    }

    /// An error in the line of the last word.
    pub(super) fn error(&self, problem: FormatProblem) -> FormatError {
        FormatError { line: self.line, problem }
    }

    /// The next word as an integer; `expected` says which, in an error.
    pub(super) fn integer(&mut self, expected: impl Fn() -> String) -> Result<usize, FormatError> {
        self.parse(expected, |word| word.parse().ok())
    }

    /// The next word as a finite number; `expected` says which, in an error.
    pub(super) fn number(&mut self, expected: impl Fn() -> String) -> Result<f64, FormatError> {
        self.parse(expected, |word| word.parse().ok().filter(|x: &f64| x.is_finite()))
    }

    /// The next word, which must be this one.
    pub(super) fn expect(&mut self, word: &str) -> Result<(), FormatError> {
        self.parse(|| format!("`{word}`"), |found| (found == word).then_some(()))
    }

    /// The next word as `parse` reads it; `expected` says what is missing if it returns `None`.
    pub(super) fn parse<T>(
        &mut self,
        expected: impl Fn() -> String,
        parse: impl Fn(&'a str) -> Option<T>,
    ) -> Result<T, FormatError> {
        match self.next() {
            Some(word) => parse(word)
                .ok_or_else(|| self.error(FormatProblem::Unexpected { expected: expected(), found: word.to_owned() })),
            None => Err(self.error(FormatProblem::Short(expected()))),
        }
    }

    /// The words of the line of the next word, from that word on; none if it is the line of the last word.
    pub(super) fn words_of_next_line(&self) -> Vec<&'a str> {
        let mut ahead = *self;
        let words: Vec<_> =
            std::iter::from_fn(|| ahead.next().map(|word| (ahead.line, word))).take(MOST_WORDS_OF_LINE).collect();
        let line = words.first().map_or(self.line, |(line, _)| *line);
        let is_next = |found: &&(usize, &str)| found.0 == line && line > self.line;
        words.iter().take_while(is_next).map(|(_, word)| *word).collect()
    }

    fn begins_comment(&self, at: usize) -> bool {
        let Syntax { comment, block_comment: [begin, _], .. } = self.syntax;
        let rest = &self.rest[at..];
        (!comment.is_empty() && rest.starts_with(comment)) || (!begin.is_empty() && rest.starts_with(begin))
    }

    fn skip_blanks(&mut self) {
        while let Some(first) = self.rest.chars().next() {
            let Syntax { comment, block_comment: [begin, end], .. } = self.syntax;
            let length = if !begin.is_empty() && self.rest.starts_with(begin) {
                let body = &self.rest[begin.len()..];
                body.find(end).map_or(self.rest.len(), |at| begin.len() + at + end.len())
            } else if !comment.is_empty() && self.rest.starts_with(comment) {
                self.rest.find(['\n', '\r']).unwrap_or(self.rest.len())
            } else if first.is_whitespace() || first == ',' {
                first.len_utf8()
            } else {
                return;
            };
            self.take(length);
        }
    }

    /// Takes some bytes of the rest, and counts their lines: LF, CRLF or CR alone end one. The end of the text begins no line.
    fn take(&mut self, length: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(length);
        let is_end = |(at, c): (usize, char)| {
            let next = taken[at + c.len_utf8()..].chars().next().or_else(|| rest.chars().next());
            next.is_some() && (c == '\n' || (c == '\r' && next != Some('\n')))
        };
        self.next_line += taken.char_indices().filter(|found| is_end(*found)).count();
        self.rest = rest;
        taken
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SYNTAX: Syntax = Syntax { comment: "//", block_comment: ["/*", "*/"], symbols: "<>" };

    fn words(text: &str) -> Vec<(usize, String)> {
        let mut scanner = Scanner::new(text, SYNTAX);
        std::iter::from_fn(|| scanner.next().map(|word| word.to_owned()).map(|word| (scanner.line, word))).collect()
    }

    #[test]
    fn words_have_their_lines() {
        let text = "\u{feff}a<1,\n-2>// b c\nd/* e\nf */g \"h i\"j";
        let expected =
            [(1, "a"), (1, "<"), (1, "1"), (2, "-2"), (2, ">"), (3, "d"), (4, "g"), (4, "\"h i\""), (4, "j")];
        assert_eq!(words(text), expected.map(|(line, word)| (line, word.to_owned())));
        for end in ["\r\n", "\r"] {
            assert_eq!(words(&text.replace('\n', end)), words(text), "{end:?}");
        }
    }

    #[test]
    fn what_does_not_end_ends_with_the_text() {
        assert_eq!(words("a /* b\nc"), [(1, "a".to_owned())]);
        assert_eq!(words("\"a b"), [(1, "\"a b".to_owned())]);
        assert_eq!(words("\"ä\nb"), [(1, "\"ä\n".to_owned()), (2, "b".to_owned())]);
        let mut scanner = Scanner::new("a\nb\n", SYNTAX);
        while scanner.next().is_some() {}
        assert_eq!(scanner.line, 2, "the last line that has text");
    }

    #[test]
    fn errors_say_what_was_expected() {
        let message = |text: &str| Scanner::new(text, SYNTAX).number(|| "x".to_owned()).unwrap_err().to_string();
        assert_eq!(message("\n\ny"), "line 3: expected x, found `y`");
        assert_eq!(message("inf"), "line 1: expected x, found `inf`");
        assert_eq!(message("\n"), "line 1: the file ends where x was expected");
        let mut scanner = Scanner::new("{ 1 2\n3", SYNTAX);
        assert!(scanner.expect("<").unwrap_err().to_string().contains("expected `<`, found `{`"));
        assert_eq!((scanner.peek(), scanner.words_of_next_line()), (Some("1"), vec![]));
        scanner.next();
        scanner.next();
        assert_eq!(scanner.words_of_next_line(), ["3"]);
    }
}
