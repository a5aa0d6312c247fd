//! Options and their values as words. One table for each struct of settings is what the command line, reports and refusals are
//! made from: an option's name, its help, its default and its values are written once, where the setting is declared.

/// The type of a setting: each value is a word of the command line.
pub trait OptionValue: Sized {
    /// The values where they can be listed, the default first.
    const CHOICES: &'static [Choice] = &[];

    /// The value as a word, from which [`Self::parse`] makes it again.
    fn word(&self) -> String;

    /// The value of a word.
    ///
    /// # Errors
    /// A sentence that says what was expected.
    fn parse(word: &str) -> Result<Self, String>;

    /// Refuses a value out of range.
    ///
    /// # Errors
    /// A sentence that says what was given and what was expected.
    fn check(&self) -> Result<(), String> {
        Ok(())
    }
}

/// A listed value.
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    /// Its word.
    pub name: &'static str,
    /// A line about it, in Markdown.
    pub help: &'static str,
}

/// A struct each field of which is an option.
pub trait OptionTable: Default + 'static {
    /// Every field.
    const OPTIONS: &'static [Setting<Self>];
}

/// A field of `S`.
#[derive(Debug)]
pub struct Setting<S> {
    /// The option's name, without the dashes.
    pub name: &'static str,
    /// The field's own name.
    pub field: &'static str,
    /// The kind of its value, in a word or two.
    pub value_name: &'static str,
    /// Its meaning, in Markdown.
    pub help: &'static str,
    /// Its values, where they can be listed.
    pub choices: &'static [Choice],
    /// Its value as a word.
    pub get: fn(&S) -> String,
    /// Sets it to the value of a word; an error says what was expected.
    pub set: fn(&mut S, &str) -> Result<(), String>,
    /// Copies it from the first to the second.
    pub copy: fn(&S, &mut S),
    /// Refuses a value out of range, with what was given and what was expected.
    pub check: fn(&S) -> Result<(), String>,
}

/// Defines an enum whose values have names on the command line and in reports. The first is the default.
macro_rules! named {
    ($(#[$doc:meta])* $name:ident { $($(#[doc = $help:literal])+ $value:ident = $text:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name {
            $($(#[doc = $help])+ $value,)+
        }

        impl $name {
            /// Every value with its name on the command line, the default first.
            pub const NAMES: &'static [(&'static str, Self)] = &[$(($text, Self::$value)),+];

            /// The value's name on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$value => $text,)+
                }
            }
        }

        impl Default for $name {
            fn default() -> Self {
                Self::NAMES[0].1
            }
        }

        /// In reports, too, a value is its name.
        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.name())
            }
        }

        impl $crate::scene::OptionValue for $name {
            const CHOICES: &'static [$crate::scene::Choice] =
                &[$($crate::scene::Choice { name: $text, help: concat!($($help),+) }),+];

            fn word(&self) -> String {
                self.name().to_owned()
            }

            fn parse(word: &str) -> Result<Self, String> {
                let found = Self::NAMES.iter().find(|(name, _)| *name == word);
                found.map(|(_, value)| *value).ok_or_else(|| format!("expected {}", [$($text),+].join(", ")))
            }
        }
    };
}

/// Defines a struct of settings and its table: a line `"name" "VALUE" field: Type` each, with `= default` where the type has
/// another or none. The doc comment is the option's help.
macro_rules! settings {
    (@default) => { Default::default() };
    (@default $default:expr) => { $default };
    ($(#[$meta:meta])* $name:ident {
        $($(#[doc = $help:literal])+ $option:literal $value_name:literal
            $field:ident: $type:ty $(= $default:expr)?,)+
    }) => {
        $(#[$meta])*
        pub struct $name {
            $($(#[doc = $help])+ pub $field: $type,)+
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: settings!(@default $($default)?),)+ }
            }
        }

        impl $crate::scene::OptionTable for $name {
            const OPTIONS: &'static [$crate::scene::Setting<Self>] = &[$($crate::scene::Setting {
                name: $option,
                field: stringify!($field),
                value_name: $value_name,
                help: concat!($($help),+),
                choices: <$type as $crate::scene::OptionValue>::CHOICES,
                get: |settings| $crate::scene::OptionValue::word(&settings.$field),
                set: |settings, word| {
                    settings.$field = $crate::scene::OptionValue::parse(word)?;
                    Ok(())
                },
                copy: |from, to| to.$field = from.$field.clone(),
                check: |settings| $crate::scene::OptionValue::check(&settings.$field),
            },)+];
        }

        impl $name {
            /// Every setting as a word, by the name of its option.
            pub fn as_options(&self) -> std::collections::BTreeMap<&'static str, String> {
                let options = <Self as $crate::scene::OptionTable>::OPTIONS.iter();
                options.map(|option| (option.name, (option.get)(self))).collect()
            }
        }
    };
}

pub(crate) use named;
pub(super) use settings;
