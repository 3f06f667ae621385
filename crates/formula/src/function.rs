//! The functions of one number or two.

dashpot_units::words! {
    /// A function that a formula may call, of pure numbers where not said otherwise.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Function, pub fn word(self) {
        /// Square root; of any dimension whose half it can have.
        Sqrt = "sqrt",
        /// Size; of any dimension.
        Abs = "abs",
        /// Exponential.
        Exp = "exp",
        /// Natural logarithm.
        Ln = "ln",
        /// Logarithm to the base 10.
        Log10 = "log10",
        /// Sine.
        Sin = "sin",
        /// Cosine.
        Cos = "cos",
        /// Tangent.
        Tan = "tan",
        /// Inverse sine.
        Asin = "asin",
        /// Inverse cosine.
        Acos = "acos",
        /// Inverse tangent.
        Atan = "atan",
        /// Hyperbolic sine.
        Sinh = "sinh",
        /// Hyperbolic cosine.
        Cosh = "cosh",
        /// Hyperbolic tangent.
        Tanh = "tanh",
        /// The smaller one of two; of any dimension.
        Min = "min",
        /// The larger one of two; of any dimension.
        Max = "max",
    }
}

impl Function {
    /// All of them.
    pub const ALL: [Self; 16] = [
        Self::Sqrt,
        Self::Abs,
        Self::Exp,
        Self::Ln,
        Self::Log10,
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Asin,
        Self::Acos,
        Self::Atan,
        Self::Sinh,
        Self::Cosh,
        Self::Tanh,
        Self::Min,
        Self::Max,
    ];

    /// The function of this word.
    pub fn of(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|own| own.word() == word)
    }

    /// How many numbers it takes.
    pub(crate) const fn arguments(self) -> usize {
        if matches!(self, Self::Min | Self::Max) { 2 } else { 1 }
    }

    /// Its value; `second` counts for the functions of two only.
    pub(crate) fn value(self, first: f64, second: f64) -> f64 {
        match self {
            Self::Sqrt => first.sqrt(),
            Self::Abs => first.abs(),
            Self::Exp => first.exp(),
            Self::Ln => first.ln(),
            Self::Log10 => first.log10(),
            Self::Sin => first.sin(),
            Self::Cos => first.cos(),
            Self::Tan => first.tan(),
            Self::Asin => first.asin(),
            Self::Acos => first.acos(),
            Self::Atan => first.atan(),
            Self::Sinh => first.sinh(),
            Self::Cosh => first.cosh(),
            Self::Tanh => first.tanh(),
            Self::Min => first.min(second),
            Self::Max => first.max(second),
        }
    }
}
