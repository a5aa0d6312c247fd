//! What a header declares: elements, their properties, and the types of these.

/// How the body is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Text, one element a line.
    Ascii,
    /// Binary, the least significant byte first.
    Little,
    /// Binary, the most significant byte first.
    Big,
}

impl Encoding {
    pub(super) fn named(word: &str) -> Option<Self> {
        match word {
            "ascii" => Some(Self::Ascii),
            "binary_little_endian" => Some(Self::Little),
            "binary_big_endian" => Some(Self::Big),
            _ => None,
        }
    }

    /// In words, with the name of the format.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Ascii => "PLY, ascii",
            Self::Little => "PLY, binary, little endian",
            Self::Big => "PLY, binary, big endian",
        }
    }
}

/// The type of a value; each fits an `f64` without loss, but for integers beyond 2^53.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    Char,
    UChar,
    Short,
    UShort,
    Int,
    UInt,
    Long,
    ULong,
    Float,
    Double,
}

impl Scalar {
    pub(super) fn named(word: &str) -> Option<Self> {
        Some(match word.to_ascii_lowercase().as_str() {
            "char" | "int8" => Self::Char,
            "uchar" | "uint8" => Self::UChar,
            "short" | "int16" => Self::Short,
            "ushort" | "uint16" => Self::UShort,
            "int" | "int32" => Self::Int,
            "uint" | "uint32" => Self::UInt,
            // Two that the format does not have.
            "long" | "int64" => Self::Long,
            "ulong" | "uint64" => Self::ULong,
            "float" | "float32" => Self::Float,
            "double" | "float64" => Self::Double,
            _ => return None,
        })
    }

    /// Its name in the format's first description.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Char => "char",
            Self::UChar => "uchar",
            Self::Short => "short",
            Self::UShort => "ushort",
            Self::Int => "int",
            Self::UInt => "uint",
            Self::Long => "int64",
            Self::ULong => "uint64",
            Self::Float => "float",
            Self::Double => "double",
        }
    }

    /// Bytes of one value in a binary body.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::Char | Self::UChar => 1,
            Self::Short | Self::UShort => 2,
            Self::Int | Self::UInt | Self::Float => 4,
            Self::Long | Self::ULong | Self::Double => 8,
        }
    }

    /// The least and the largest value of an integer type.
    pub(super) fn range(self) -> Option<(i128, i128)> {
        Some(match self {
            Self::Char => (i8::MIN.into(), i8::MAX.into()),
            Self::UChar => (0, u8::MAX.into()),
            Self::Short => (i16::MIN.into(), i16::MAX.into()),
            Self::UShort => (0, u16::MAX.into()),
            Self::Int => (i32::MIN.into(), i32::MAX.into()),
            Self::UInt => (0, u32::MAX.into()),
            Self::Long => (i64::MIN.into(), i64::MAX.into()),
            Self::ULong => (0, u64::MAX.into()),
            Self::Float | Self::Double => return None,
        })
    }
}

/// One value, or a list of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    One(Scalar),
    List { length: Scalar, item: Scalar },
}

/// A named value of each element of a kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub name: String,
    pub kind: Kind,
}

/// A kind of element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub name: String,
    /// How many of them the body has, as the header says.
    pub count: u64,
    /// In the order of the body.
    pub properties: Vec<Property>,
}

impl Element {
    /// Whether it has one of these names, in any letters.
    pub(super) fn is_named(&self, names: &[&str]) -> bool {
        names.iter().any(|name| self.name.eq_ignore_ascii_case(name))
    }

    /// The number of the property of this name that is one value; without such, of this name in any letters.
    pub(super) fn scalar(&self, name: &str) -> Option<usize> {
        let find = |is_named: &dyn Fn(&str) -> bool| {
            self.properties.iter().position(|p| is_named(&p.name) && matches!(p.kind, Kind::One(_)))
        };
        find(&|own| own == name).or_else(|| find(&|own| own.eq_ignore_ascii_case(name)))
    }

    /// The fewest bytes that one element can take, its lists empty.
    pub(super) fn min_bytes(&self, encoding: Encoding) -> u64 {
        let of_property = |property: &Property| match (encoding, property.kind) {
            // A digit and a separator.
            (Encoding::Ascii, _) => 2,
            (_, Kind::One(scalar) | Kind::List { length: scalar, .. }) => scalar.bytes() as u64,
        };
        self.properties.iter().map(of_property).sum()
    }

    /// Whether each element has as many bytes in a binary body.
    pub(super) fn is_fixed(&self) -> bool {
        self.properties.iter().all(|p| matches!(p.kind, Kind::One(_)))
    }
}
