//! One file, several shaders: a line `// Permutations: points quads | plain rays` compiles it once for every choice of a
//! word from each group, with the words, in capitals, as macros. Several such lines add up; none is the file as it is.
//! A word `_` stands for nothing.

/// How such a line begins.
const DIRECTIVE: &str = "// Permutations:";

/// The words of each permutation that the source asks for.
pub fn permutations(source: &str) -> Vec<Vec<String>> {
    let mut all = Vec::new();
    for line in source.lines().filter_map(|line| line.strip_prefix(DIRECTIVE)) {
        let mut choices = vec![Vec::new()];
        for group in line.split('|') {
            let words: Vec<_> = group.split_whitespace().map(str::to_owned).collect();
            choices = choices
                .iter()
                .flat_map(|chosen| {
                    words.iter().map(move |word| [chosen.as_slice(), std::slice::from_ref(word)].concat())
                })
                .collect();
        }
        all.extend(choices);
    }
    for words in &mut all {
        words.retain(|word| *word != "_");
    }
    if all.is_empty() { vec![Vec::new()] } else { all }
}

/// The name of a permutation: `visibility_points_plain.vert` of `visibility.vert`.
pub fn name(file: &str, words: &[String]) -> String {
    let (pass, stage) = file.rsplit_once('.').unwrap_or((file, ""));
    let words: String = words.iter().map(|word| format!("_{word}")).collect();
    format!("{pass}{words}.{stage}")
}
