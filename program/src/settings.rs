//! Options made from the library's tables of settings, which have their values, defaults and help.

use std::marker::PhantomData;

use clap::{
    Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches,
    builder::{PossibleValue, PossibleValuesParser, TypedValueParser, ValueParser},
    error::ErrorKind,
    parser::ValueSource,
};
use surfel::scene::{OptionTable, OptionValue, Setting};

/// The settings of a table that a subcommand takes.
pub trait Taken {
    /// The table.
    type Table: OptionTable;

    /// The option of this name as the subcommand has it; `None` where it has none.
    fn option(_name: &str, option: Arg) -> Option<Arg> {
        Some(option)
    }
}

/// The settings that the command line gives, by itself or by a default.
pub struct Given<T: Taken> {
    values: T::Table,
    given: Vec<&'static Setting<T::Table>>,
    /// Of these, what is given by no default.
    said: Vec<&'static Setting<T::Table>>,
    taken: PhantomData<T>,
}

impl<T: Taken<Table: Clone>> Clone for Given<T> {
    fn clone(&self) -> Self {
        let (given, said) = (self.given.clone(), self.said.clone());
        Self { values: self.values.clone(), given, said, taken: PhantomData }
    }
}

impl<T: Taken> Given<T> {
    /// `base` but for what is given.
    pub fn over(&self, mut base: T::Table) -> T::Table {
        for setting in &self.given {
            (setting.copy)(&self.values, &mut base);
        }
        base
    }

    /// Whether the setting of that name is given by no default.
    pub fn says(&self, name: &str) -> bool {
        self.said.iter().any(|setting| setting.name == name)
    }

    /// The names of what is given by no default.
    pub fn said(&self) -> impl Iterator<Item = &'static str> {
        self.said.iter().map(|setting| setting.name)
    }

    /// `base` but for what is given by no default.
    pub fn said_over(&self, mut base: T::Table) -> T::Table {
        for setting in &self.said {
            (setting.copy)(&self.values, &mut base);
        }
        base
    }
}

impl<T: Taken> Args for Given<T> {
    fn augment_args(command: Command) -> Command {
        let options = T::Table::OPTIONS.iter();
        command.args(options.filter_map(|setting| T::option(setting.name, option(setting))))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<T: Taken> FromArgMatches for Given<T> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let (mut values, mut given, mut said) = (T::Table::default(), Vec::new(), Vec::new());
        for setting in T::Table::OPTIONS {
            if let Ok(Some(words)) = matches.try_get_many::<String>(setting.name) {
                // One word, but of what is given more than once. Each by itself was read before, so that a fault is in their being together.
                let words: Vec<&str> = words.map(String::as_str).collect();
                let refused = |problem: String| {
                    let said = format!("--{}: {} together: {problem}", setting.name, words.join(" and "));
                    clap::Error::raw(ErrorKind::ValueValidation, said)
                };
                (setting.set)(&mut values, &words.join(";")).map_err(refused)?;
                given.push(setting);
                if matches.value_source(setting.name) != Some(ValueSource::DefaultValue) {
                    said.push(setting);
                }
            }
        }
        Ok(Self { values, given, said, taken: PhantomData })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The setting that may be given more than once.
const REPEATED: &str = "clip-plane";

/// The option of a setting, as its table has it.
fn option<S: OptionTable>(setting: &'static Setting<S>) -> Arg {
    let choices = setting.choices.iter();
    let choices = choices.map(|choice| PossibleValue::new(choice.name).help(plain(choice.help)));
    let parser: ValueParser = match setting.choices {
        [] => ValueParser::new(|word: &str| (setting.set)(&mut S::default(), word).map(|()| word.to_owned())),
        _ => PossibleValuesParser::new(choices).into(),
    };
    Arg::new(setting.name)
        .long(setting.name)
        .value_name(setting.value_name)
        .default_value((setting.get)(&S::default()))
        .help(plain(setting.help))
        .value_parser(parser)
        .allow_hyphen_values(setting.choices.is_empty())
        .action(if setting.name == REPEATED { ArgAction::Append } else { ArgAction::Set })
}

/// Markdown as help has it.
fn plain(markdown: &str) -> String {
    markdown.trim().trim_end_matches('.').replace('`', "")
}

/// One of these values.
pub fn one_of<T: OptionValue + Copy + Send + Sync + 'static>(
    values: &'static [(&'static str, T)],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(values.iter().map(|(name, _)| *name)).try_map(|word| T::parse(&word))
}

/// Values that a word of a list stands for.
#[derive(Clone)]
pub struct Listed<T>(Vec<T>);

/// One of these values, or `all` of them.
pub fn listed<T: Copy + Send + Sync + 'static>(
    values: &'static [(&'static str, T)],
) -> impl TypedValueParser<Value = Listed<T>> {
    let names = values.iter().map(|(name, _)| *name).chain(["all"]);
    PossibleValuesParser::new(names).map(move |word| {
        let named = values.iter().filter(|(name, _)| *name == word || word == "all");
        Listed(named.map(|(_, value)| *value).collect())
    })
}

/// Every value that a list names, once, in its order; `default` where there is no list.
pub fn chosen<T: Copy + PartialEq>(list: &[Listed<T>], default: &[T]) -> Vec<T> {
    let named: Vec<T> = list.iter().flat_map(|listed| listed.0.iter().copied()).collect();
    once(&named, default)
}

/// The values, each once; `default` where there is none.
pub fn once<T: Copy + PartialEq>(values: &[T], default: &[T]) -> Vec<T> {
    let mut all: Vec<T> = Vec::new();
    for value in if values.is_empty() { default } else { values } {
        if !all.contains(value) {
            all.push(*value);
        }
    }
    all
}
