//! The paths that Rust source text uses, found without a compiler: enough of the grammar to tell which modules a file
//! names, in `use` trees and in expressions alike.

/// A path from a root: `crate` (also where the text says `super` or `self`) or `ash`; then the next names, two at most.
#[derive(Debug, PartialEq, Eq)]
pub struct UsedPath {
    /// `crate` or `ash`, and the names after it; `*` for a glob.
    pub segments: Vec<String>,
    /// Of the name after the root, counted from 1.
    pub line: usize,
}

/// Every path in a file of `src/` that starts at the crate or at `ash`. `file` is relative to `src/`; with it, `super`
/// is resolved.
pub fn used_paths(file: &str, text: &str) -> Vec<UsedPath> {
    let tokens = tokens(text);
    let mut module: Vec<String> = file.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    if module.last().is_some_and(|last| last == "mod") {
        module.pop();
    }
    let mut found = Vec::new();
    // For each open brace: whether it opened an inline module.
    let mut braces = Vec::new();
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        let word = token.text.as_str();
        let next = |ahead: usize| tokens.get(at + ahead).map_or("", |t| t.text.as_str());
        if word == "{" {
            let is_module = at >= 2 && tokens[at - 2].text == "mod";
            if is_module {
                module.push(tokens[at - 1].text.clone());
            }
            braces.push(is_module);
        } else if word == "}" {
            if braces.pop() == Some(true) {
                module.pop();
            }
        } else if matches!(word, "crate" | "self" | "super" | "ash")
            && next(1) == "::"
            && (at == 0 || tokens[at - 1].text != "::")
        {
            // The tree starts from the module in which the text stands, or from a root.
            at = tree(&tokens, at, Start::Module(&module), &mut found);
            continue;
        }
        at += 1;
    }
    found
}

/// From where a path goes on.
#[derive(Clone)]
enum Start<'a> {
    /// The names below the crate's root.
    Module(&'a [String]),
    /// Right after `ash`.
    Ash,
    /// Right after a folder, which was already noted.
    Folder(String),
    /// Nothing that counts: a name below one that was already noted.
    Noted,
}

/// Reads one path or `use` tree from token `at` and notes what it names; answers with the token after it.
fn tree(tokens: &[Token], mut at: usize, mut start: Start, found: &mut Vec<UsedPath>) -> usize {
    let mut is_first = true;
    while let Some(Token { text, line }) = tokens.get(at) {
        let mut note = |roots: &[&str]| {
            let segments = roots.iter().copied().chain([text.as_str()]).map(str::to_owned).collect();
            found.push(UsedPath { segments, line: *line });
        };
        at += 1;
        start = match (text.as_str(), start) {
            ("{", start) => {
                while tokens.get(at).is_some_and(|t| t.text != "}") {
                    at = tree(tokens, at, start.clone(), found);
                    if tokens.get(at).is_some_and(|t| t.text == ",") {
                        at += 1;
                    }
                }
                return at + 1;
            }
            ("crate", Start::Module(_)) => Start::Module(&[]),
            ("self", start) => start,
            ("super", Start::Module(path)) => Start::Module(&path[..path.len().saturating_sub(1)]),
            ("ash", Start::Module(_)) if is_first => Start::Ash,
            (_, Start::Module([])) => {
                note(&["crate"]);
                Start::Folder(text.clone())
            }
            (_, Start::Folder(folder)) => {
                note(&["crate", &folder]);
                Start::Noted
            }
            (_, Start::Module([folder])) => {
                note(&["crate", folder]);
                Start::Noted
            }
            // A name within the own folder.
            (_, Start::Module(_)) => Start::Noted,
            (_, Start::Ash) => {
                note(&["ash"]);
                Start::Noted
            }
            (_, Start::Noted) => Start::Noted,
        };
        is_first = false;
        if tokens.get(at).is_some_and(|t| t.text == "::") {
            at += 1;
            // A turbofish: its types are read as paths of their own.
            if tokens.get(at).is_some_and(|t| t.text == "<") {
                return at;
            }
        } else {
            // `as name` ends a tree too.
            while tokens.get(at).is_some_and(|t| t.text == "as") {
                at += 2;
            }
            return at;
        }
    }
    at
}

/// A word, `::`, or one other character.
pub struct Token {
    pub text: String,
    line: usize,
}

/// The text without comments, strings, characters and lifetimes.
pub fn tokens(text: &str) -> Vec<Token> {
    let chars: Vec<char> = text.chars().collect();
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let starts_with = |at: usize, what: &str| what.chars().zip(at..).all(|(c, i)| chars.get(i) == Some(&c));
    let mut tokens = Vec::new();
    let (mut at, mut line) = (0, 1);
    while at < chars.len() {
        let from = at;
        match chars[at] {
            '/' if starts_with(at, "//") => {
                while at < chars.len() && chars[at] != '\n' {
                    at += 1;
                }
            }
            '/' if starts_with(at, "/*") => {
                let mut depth = 0;
                while at < chars.len() {
                    if starts_with(at, "/*") {
                        depth += 1;
                        at += 2;
                    } else if starts_with(at, "*/") {
                        depth -= 1;
                        at += 2;
                    } else {
                        at += 1;
                    }
                    if depth == 0 {
                        break;
                    }
                }
            }
            '"' => at = after_string(&chars, at),
            '\'' => at = after_quote(&chars, at),
            'r' | 'b' | 'c' if raw_hashes(&chars, at).is_some() => {
                let (quote, hashes) = raw_hashes(&chars, at).unwrap_or((at, 0));
                let end = format!("\"{}", "#".repeat(hashes));
                at = quote + 1;
                while at < chars.len() && !starts_with(at, &end) {
                    at += 1;
                }
                at += end.len();
            }
            c if is_word(c) => {
                while at < chars.len() && is_word(chars[at]) {
                    at += 1;
                }
                tokens.push(Token { text: chars[from..at].iter().collect(), line });
            }
            ':' if starts_with(at, "::") => {
                at += 2;
                tokens.push(Token { text: "::".to_owned(), line });
            }
            c => {
                at += 1;
                if !c.is_whitespace() {
                    tokens.push(Token { text: c.to_string(), line });
                }
            }
        }
        at = at.min(chars.len());
        line += chars[from..at].iter().filter(|c| **c == '\n').count();
    }
    tokens
}

/// Where a string with escapes that opens at `at` is over.
fn after_string(chars: &[char], mut at: usize) -> usize {
    at += 1;
    while at < chars.len() && chars[at] != '"' {
        at += if chars[at] == '\\' { 2 } else { 1 };
    }
    at + 1
}

/// Where the character that opens at `at` is over; a lifetime has no closing quote, of it only the quote is skipped.
fn after_quote(chars: &[char], at: usize) -> usize {
    match (chars.get(at + 1), chars.get(at + 2)) {
        (Some('\\'), _) => {
            let mut end = at + 3;
            while end < chars.len() && chars[end] != '\'' {
                end += 1;
            }
            end + 1
        }
        (Some(_), Some('\'')) => at + 3,
        _ => at + 1,
    }
}

/// For a raw string at `at` (`r"`, `br#"`, …): where its quote is, and how many `#` it has.
fn raw_hashes(chars: &[char], at: usize) -> Option<(usize, usize)> {
    // The `r` of `for` is none; words are taken whole before this is asked.
    let r = if chars[at] == 'r' { at } else { at + 1 };
    if chars.get(r) != Some(&'r') {
        return None;
    }
    let hashes = chars[r + 1..].iter().take_while(|c| **c == '#').count();
    (chars.get(r + 1 + hashes) == Some(&'"')).then_some((r + 1 + hashes, hashes))
}
