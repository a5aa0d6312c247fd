//! Declarations, and what is public of them, found among the tokens of a source file.

use std::fmt::Write as _;

use crate::import_direction::paths::{self, Token};

/// The tokens of a text without its lifetimes.
pub(super) fn tokens(text: &str) -> Vec<Token> {
    let is_word = |c: &char| c.is_alphanumeric() || *c == '_';
    let chars: Vec<char> = text.chars().collect();
    let (mut plain, mut at) = (String::new(), 0);
    while at < chars.len() {
        let word = chars[at + 1..].iter().take_while(|c| is_word(c)).count();
        let is_lifetime = chars[at] == '\'' && word > 0 && chars.get(at + 1 + word) != Some(&'\'');
        if is_lifetime && at > 0 && !is_word(&chars[at - 1]) {
            at += 1 + word;
        } else {
            plain.push(chars[at]);
            at += 1;
        }
    }
    paths::tokens(&plain)
}

/// The tokens from one on up to where its declaration ends: at a `;`, or at the brace of its body, outside of all brackets.
pub(super) fn head(tokens: &[Token]) -> &[Token] {
    let mut depth = 0;
    for (i, token) in tokens.iter().enumerate() {
        match token.text.as_str() {
            "(" | "[" => depth += 1,
            ")" | "]" => depth -= 1,
            ";" | "{" if depth == 0 => return &tokens[..i],
            _ => {}
        }
    }
    tokens
}

/// The tokens between a brace and the one that closes it.
fn body(tokens: &[Token]) -> &[Token] {
    let mut depth = 0;
    let open = tokens.iter().position(|token| token.text == "{").unwrap_or(tokens.len());
    for (i, token) in tokens.iter().enumerate().skip(open) {
        match token.text.as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return &tokens[open + 1..i];
        }
    }
    &[]
}

/// Tokens with the spaces that a reader wants.
fn text(tokens: &[Token]) -> String {
    let mut text = String::new();
    for token in tokens {
        let word = token.text.as_str();
        let tight =
            matches!(word, "," | ";" | ":" | ")" | "]" | ">" | "<" | "(" | "[" | "." | "?" | "!" | "::")
                || text.ends_with(['(', '[', '<', '&', '!', '*', '.', '#'])
                || text.ends_with("::")
                || text.is_empty();
        if !(tight || word == ">" && text.ends_with('-')) {
            text.push(' ');
        }
        text.push_str(word);
    }
    let plain = [
        ("- >", "->"),
        ("->", " -> "),
        ("= =", "=="),
        (":[", ": ["),
        ("=[", "= ["),
        (",[", ", ["),
        ("<, ", "<"),
        ("<>", ""),
        (",)", ")"),
        ("  ", " "),
    ];
    plain.into_iter().fold(text, |text, (from, to)| text.replace(from, to))
}

/// The parts of a body that commas part, outside of all brackets, without attributes.
fn parts<'t>(tokens: &'t [Token]) -> Vec<&'t [Token]> {
    let (mut depth, mut first, mut parts) = (0_i32, 0, Vec::new());
    for (i, token) in tokens.iter().enumerate() {
        match token.text.as_str() {
            "(" | "[" | "{" | "<" => depth += 1,
            ")" | "]" | "}" | ">" if !(token.text == ">" && i > 0 && tokens[i - 1].text == "-") => depth -= 1,
            "," if depth == 0 => {
                parts.push(&tokens[first..i]);
                first = i + 1;
            }
            _ => {}
        }
    }
    parts.push(&tokens[first..]);
    let plain = |mut part: &'t [Token]| {
        while let [hash, rest @ ..] = part {
            if hash.text == "#" {
                let end = rest.iter().position(|token| token.text == "]").map_or(rest.len(), |end| end + 1);
                part = &rest[end..];
            } else {
                break;
            }
        }
        part
    };
    parts.into_iter().map(plain).filter(|part| !part.is_empty()).collect()
}

/// What is public of a declaration that begins at a `pub` or, in a table of settings or an enum of names, at its name.
pub(super) fn declaration(tokens: &[Token]) -> String {
    let of_settings = tokens[0].text != "pub";
    let is = |word: &str| head(tokens).iter().any(|token| token.text == word);
    // A table has types.
    let kind = if body(tokens).iter().any(|token| token.text == ":") { "struct" } else { "enum" };
    let first = if of_settings { format!("pub {kind} {}", tokens[0].text) } else { text(head(tokens)) };
    let mut lines = match is("struct") {
        // What is in parentheses is private.
        true => first.split('(').next().unwrap_or_default().to_owned(),
        false => first,
    };
    if is("fn") {
        return lines;
    }
    if is("trait") {
        let inside = body(tokens);
        for at in (0..inside.len()).filter(|at| inside[*at].text == "fn") {
            write!(lines, "\n    {}", text(head(&inside[at..]))).unwrap();
        }
        return lines;
    }
    if is("const") || is("type") {
        return lines.split(" = ").next().unwrap_or_default().to_owned();
    }
    for part in parts(body(tokens)) {
        let public = is("enum")
            || of_settings
            || part[0].text == "pub" && part.get(1).is_none_or(|next| next.text != "(");
        let part = text(part);
        let part = part.split(" = ").next().unwrap_or_default().trim_end_matches(" =");
        if public {
            write!(lines, "\n    {part}").unwrap();
        }
    }
    lines
}

/// The public functions and constants of the implementations of a type, in this file.
pub(super) fn implemented(tokens: &[Token], name: &str, found: &mut Vec<String>) {
    for at in (0..tokens.len()).filter(|at| tokens[*at].text == "impl") {
        let whole = head(&tokens[at..]);
        // After `for`, or after what it is generic over.
        let of = whole.iter().rposition(|token| token.text == "for");
        let own =
            whole.iter().skip(1).filter(|token| token.text != "<" && token.text != ">" && token.text != "_");
        let is_own = of.is_none() && own.clone().next().is_some_and(|token| token.text == name);
        if let Some(of) = of {
            if whole.get(of + 1).is_some_and(|token| token.text == name) {
                found.push(text(whole));
            }
            continue;
        }
        if !is_own {
            continue;
        }
        let inside = body(&tokens[at..]);
        let mut depth = 0;
        for (i, token) in inside.iter().enumerate() {
            match token.text.as_str() {
                "{" => depth += 1,
                "}" => depth -= 1,
                "pub" if depth == 0 && inside.get(i + 1).is_some_and(|next| next.text != "(") => {
                    let head = text(head(&inside[i..]));
                    let is_const = inside[i + 1].text == "const" && inside[i + 2].text != "fn";
                    let end = if is_const { head.find(" = ") } else { None };
                    found.push(head[..end.unwrap_or(head.len())].to_owned());
                }
                _ => {}
            }
        }
    }
}
