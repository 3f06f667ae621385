//! What the thesis misprints, with the correct form, and what each of the two gives.

use dashpot_report::Table;

use crate::{
    Constants, Groups, Impact, Padding, Pulse, STANDARD_GRAVITY, Scales, Study, Support,
    ThesisError, groups::two_maxwell, words::significant,
};

/// A misprint. The scan of the thesis is poor in places, so some may be the scan's.
#[derive(Debug, Clone, PartialEq)]
pub struct Misprint {
    /// Equation or chapter.
    pub place: &'static str,
    /// What is printed.
    pub printed: &'static str,
    /// What is right.
    pub correct: &'static str,
    /// What the two give, where that is simple.
    pub demonstration: Option<Demonstration>,
}

/// Both forms evaluated, beside what has to come out.
#[derive(Debug, Clone, PartialEq)]
pub struct Demonstration {
    /// What is evaluated.
    pub what: &'static str,
    /// By the printed form.
    pub printed: f64,
    /// By the correct form.
    pub correct: f64,
    /// What comes out another way.
    pub truth: f64,
}

impl Misprint {
    fn plain(place: &'static str, printed: &'static str, correct: &'static str) -> Self {
        Self { place, printed, correct, demonstration: None }
    }

    fn shown(self, what: &'static str, [printed, correct, truth]: [f64; 3]) -> Self {
        let demonstration = Some(Demonstration { what, printed, correct, truth });
        Self { demonstration, ..self }
    }
}

/// All misprints in the order of the text.
///
/// # Errors
///
/// [`ThesisError::EquivalentModel`] where appendix A has no answer; for its padding it has.
pub fn misprints(study: &Study) -> Result<Vec<Misprint>, ThesisError> {
    let mut all = chapter_2();
    all.extend(chapter_3(study));
    all.extend(chapters_4_and_5(study));
    all.extend(appendix_a()?);
    all.extend(appendices_b_and_c(study));
    all.extend(appendix_d());
    Ok(all)
}

fn chapter_2() -> Vec<Misprint> {
    let Scales { mass, speed, thickness } = Scales::CHAPTER_4;
    let support = Groups::PRINTED.support(&Scales::CHAPTER_4).mass;
    // As an example, m₂ = m₁.
    let (second, gravity) = (mass, STANDARD_GRAVITY);
    let share = mass / (mass + second);
    let weight = gravity * thickness / (speed * speed);
    vec![
        Misprint::plain("nomenclature", "β: damping support parameter", "β: elastic one (2.35)"),
        Misprint::plain("II", "there is no 2.3", "2.4 follows 2.2"),
        Misprint::plain("2.10", "numbered 2.20", "2.10; 2.20 is ζ″ = A − B φ"),
        Misprint::plain("2.15", "used twice", "for ẋ₁ = V₀ and for τ* = τ V₀/δ"),
        Misprint::plain("2.36", "γ = m₁/m₂", "γ = m₁/m₃")
            .shown("γ with m₂ = 0", [mass / 0.0, mass / support, Groups::PRINTED.gamma]),
        Misprint::plain("II, gravity", "V₀² ≫ (m₁ + m₂)/m₁ g δ", "V₀² ≫ m₁/(m₁ + m₂) g δ").shown(
            "right side over V₀² with m₂ = m₁; 2.27 gives A",
            [
                weight / share,
                weight * mass / (mass + second),
                share * gravity * thickness / (speed * speed),
            ],
        ),
        Misprint::plain("III, beginning", "normalized energy absorption φ", "… ω"),
    ]
}

fn chapter_3(study: &Study) -> Vec<Misprint> {
    let pulse = Pulse::PRINTED;
    let Some(own) = pulse.constants() else { return Vec::new() };
    let Groups { a, b, c, .. } = pulse.padding;
    let (p, m, nu) = (pulse.slope, pulse.decay, own.nu);
    let quotient = |last: f64| {
        let terms = m.powi(4) * (1.0 / nu - c / (p * nu)) + 2.0 * m.powi(3) * (c / p - 1.0);
        let square = m * m * (nu - b / nu - last);
        -p / (c * (m * (m - nu)).powi(2)) * (terms + square + 2.0 * m * b - nu * b)
    };
    let second = |last: f64| {
        let terms = m * m * (1.0 - c / p) + 2.0 * nu * m * (c / p - 1.0) + (a * nu - b - last);
        p / (c * nu * (m - nu).powi(2)) * terms
    };
    let rho = p / c * (m * m - a * m + b);
    let r1 = |rho: f64| rho / (m * (m - nu));
    let slope = |sign: f64| sign * nu * own.l2 + own.r1 - m * own.r2;
    let Padding { k1, c1, .. } = Padding::CHAPTER_4;
    let Scales { speed, thickness, .. } = Scales::CHAPTER_4;
    let ratio = k1 * thickness / (c1 * speed);
    // Early enough for every term to matter.
    let time = 0.5;
    let [printed_3_60, mended_3_60] = forms_of_3_60(&pulse, &own, time);
    vec![
        Misprint::plain("3.5", "c ρ = (A/c)(m² − a m + b)", "ρ = (A/c)(m² − a m + b)")
            .shown("R₁ by 3.16, and by 3.18", [r1(rho / c), r1(rho), own.r1]),
        Misprint::plain("3.24", "L₂ e^(−ντ) (ν) + …", "L₂ e^(−ντ) (−ν) + …")
            .shown("ξ′(0), which is 1 by 3.22", [slope(1.0), slope(-1.0), 1.0]),
        Misprint::plain("3.28", "m² (ν − b/ν − c/(A ν))", "m² (ν − b/ν − (c/A) ν), as in 3.55")
            .shown("L₁, and by 3.27", [quotient(c / (p * nu)), quotient(c / p * nu), own.l1]),
        Misprint::plain("3.29", "(a ν − b − c/(A ν²))", "(a ν − b − (c/A) ν²)")
            .shown("L₂, and by 3.26", [second(c / (p * nu * nu)), second(c / p * nu * nu), own.l2]),
        Misprint::plain("after 3.54", "ν = K₁ δ/(τ*max C V₀)", "ν = K₁ δ/(C₁ V₀)").shown(
            "ν of chapter IV, and as d/c",
            [ratio / study.printed.deepest().time, ratio, Groups::PRINTED.d / c],
        ),
        Misprint::plain("3.58", "W = …", "ω = …; W is m₁ V₀² ω (3.56)"),
        Misprint::plain(
            "3.60",
            "garbled: … [… + e^(−2mτ)/(4m²)] {2A m² τ² (R₁ + R₂) + A m R₂} …",
            "ω = e^(−(ν+m)τ) A ν L₂ {1 + τ(ν+m)}/(ν+m)² + e^(−2mτ)/(4m²) {2A m² τ (R₁ τ + R₂) + \
             A m R₂} − A R₂/(4m) − A ν L₂/(ν+m)²",
        )
        .shown(
            "ω(0.5), and by quadrature of 3.57",
            [printed_3_60, mended_3_60, pulse.energy(time)],
        ),
    ]
}

/// 3.60 as the scan has it, with L₂ for its C₂, and as it follows from 3.59.
fn forms_of_3_60(pulse: &Pulse, own: &Constants, time: f64) -> [f64; 2] {
    let (p, m, nu) = (pulse.slope, pulse.decay, own.nu);
    let sum = nu + m;
    let (once, twice) = ((-sum * time).exp(), (-2.0 * m * time).exp() / (4.0 * m * m));
    let bracket = p * nu * own.l2 * (1.0 + time * sum) / (sum * sum) + twice;
    let brace = 2.0 * p * m * m * time * time * (own.r1 + own.r2) + p * m * own.r2;
    let last = p * own.r2 / (4.0 * m);
    let printed = once * bracket * brace - last * p * nu * own.l2 / (sum * sum);
    let flow = p * nu * own.l2 / (sum * sum);
    let brace = 2.0 * p * m * m * time * (own.r1 * time + own.r2) + p * m * own.r2;
    [printed, once * flow * (1.0 + time * sum) + twice * brace - last - flow]
}

fn chapters_4_and_5(study: &Study) -> Vec<Misprint> {
    let energy = study.printed.energy(5.0);
    let scales = Scales::CHAPTER_4;
    let damping = Groups::PRINTED.support(&scales).damping;
    let alpha = |damping: f64| damping * scales.time() / Groups::PRINTED.support(&scales).mass;
    vec![
        Misprint::plain("IV", "m = 100 kg", "m₃ = 100 kg"),
        Misprint::plain("IV", "C₃ = 10×10⁶ N s/m", "C₃ = 10×10³ N s/m, or α = 200").shown(
            "α, which is printed as 0.2",
            [alpha(10e6), alpha(damping), Groups::PRINTED.alpha],
        ),
        Misprint::plain("4.1", "ω = τ* ∫ φ ξ′ dτ*", "ω = ∫ φ ξ′ dτ*").shown(
            "ω(5) of the base, and the area under its stress–strain curve",
            [5.0 * energy, energy, area(&study.printed, 5.0)],
        ),
        Misprint::plain("5.1", "m V₀²", "m₁ V₀²"),
    ]
}

/// Area under the stress–strain curve until τ*, by trapezia.
fn area(impact: &Impact, end: f64) -> f64 {
    /// Their error falls with the square of this; here it is below 1e-6.
    const STEPS: u32 = 12_000;
    let point = |at: u32| {
        let time = end * f64::from(at) / f64::from(STEPS);
        (impact.deformation(time), impact.force(time))
    };
    let pair = |at: u32| {
        let ((x, f), (next_x, next_f)) = (point(at), point(at + 1));
        f64::midpoint(f, next_f) * (next_x - x)
    };
    (0..STEPS).map(pair).sum()
}

fn appendix_a() -> Result<Vec<Misprint>, ThesisError> {
    // With K₁ = K₂, as in chapter IV, A.9 would not show.
    let padding = Padding { k1: 10e6, ..Padding::CHAPTER_4 };
    let Padding { k1, c1, k2, c2 } = padding;
    let truth = 1e-6 * two_maxwell(padding)?.slow.spring;
    let third = |alpha: f64, beta: f64| {
        1e-6 * (k2 * alpha + k2 * beta - k2 * k2 / c1 - k2 * k2 / c2) / (2.0 * beta)
    };
    let product = k1 * k2 / (c1 * c2);
    let printed = 0.5 * (k2 / c2 + k2 / c1 + k2 / c1);
    let right = 0.5 * (k2 / c2 + k2 / c1 + k1 / c1);
    let root = |alpha: f64| (alpha * alpha - product).sqrt();
    let correct = third(right, root(right));
    Ok(vec![
        Misprint::plain(
            "A.9",
            "α = K₂/(2C₂) + K₂/(2C₁) + K₂/(2C₁)",
            "α = K₂/(2C₂) + K₂/(2C₁) + K₁/(2C₁)",
        )
        .shown(
            "K₃ of A.5 in MN/m with K₁ = 10 MN/m, and from A.1 to A.4",
            [third(printed, root(printed)), correct, truth],
        ),
        Misprint::plain("A.10", "β = α² − K₁K₂/(C₁C₂)", "β = √(α² − K₁K₂/(C₁C₂))")
            .shown("the same K₃", [third(right, right * right - product), correct, truth]),
    ])
}

fn appendices_b_and_c(study: &Study) -> Vec<Misprint> {
    let Padding { k1, c1, k2, c2 } = Padding::CHAPTER_4;
    let time = Scales::CHAPTER_4.time();
    let rate = k2 / c1 * (1.0 + k1 / k2 + c1 / c2);
    let Groups { a, c, d, .. } = study.printed.groups;
    vec![
        Misprint::plain("B, title", "derivation of equation 2.11", "… of equation 2.12"),
        Misprint::plain("B.6", "(K₁/C₂) Ḟ", "(K₁/C₂) F"),
        Misprint::plain("C.6", "… (δ/V₀)² (V₀/δ)²", "… (δ/V₀)² (V₀/δ)² φ"),
        Misprint::plain("C.15", "first term without φ", "−K₁K₂/(C₁C₂) (m₁V₀²/δ) φ"),
        Misprint::plain("C.16", "φ̇ times … (V₀/δ)", "φ̇ times … (δ/V₀)").shown(
            "a of chapter IV, and by 2.29",
            [rate / time, rate * time, study.system.groups.a],
        ),
        Misprint::plain("C.17", "… + c ξ̇ + d ξ̈", "… + c ξ̈ + d ξ̇ (2.22)").shown(
            "φ″(0), and of the exact force",
            [-a * c + c, -a * c + d, study.printed.curvature(0.0)],
        ),
        Misprint::plain("C.29", "φ = K₂δ²/(m₁V₀²)", "φ′ = K₂δ²/(m₁V₀²)")
            .shown("φ(0), and by 2.24", [c, study.printed.force(0.0), 0.0]),
    ]
}

fn appendix_d() -> Vec<Misprint> {
    let (scales, pad) = (Scales::CHAPTER_4, Padding::CHAPTER_4);
    let Scales { mass, .. } = scales;
    let j = scales.time();
    let own = Groups::of(&scales, &pad, &Support::CHAPTER_4);
    let Groups { a, b, c, d, .. } = own;
    let printed = a - c * c / d - d / c;
    vec![
        Misprint::plain("D.4", "d = K₁K₂J³/(C₁ m)", "d = K₁K₂J³/(C₁ m₁)"),
        Misprint::plain("D.6", "C₂ = (d/c) m₁/J", "C₂ = (d/b) m₁/J")
            .shown("C₂ of chapter IV in N s/m", [d / c * mass / j, d / b * mass / j, pad.c2]),
        Misprint::plain("D.8", "K₂/C₂ = c²/(d J)", "K₂/C₂ = b c/(d J)").shown(
            "K₂/C₂ of chapter IV in 1/s",
            [c * c / (d * j), b * c / (d * j), pad.k2 / pad.c2],
        ),
        Misprint::plain("D.9", "C₁ = c m₁/((a − c²/d − d/c) J)", "C₁ = c m₁/((a − b c/d − d/c) J)")
            .shown(
                "C₁ of chapter IV in N s/m",
                [c * mass / (printed * j), c * mass / (own.q() * j), pad.c1],
            ),
        Misprint::plain(
            "D.10",
            "K₁ = d m₁/((a − c²/d − d/c) J²)",
            "K₁ = d m₁/((a − b c/d − d/c) J²)",
        )
        .shown(
            "K₁ of chapter IV in N/m",
            [d * mass / (printed * j * j), d * mass / (own.q() * j * j), pad.k1],
        ),
    ]
}

/// The misprints as a table.
pub fn misprint_table(all: &[Misprint]) -> Table {
    let row = |misprint: &Misprint| {
        let mut cells = vec![
            misprint.place.to_owned(),
            misprint.printed.to_owned(),
            misprint.correct.to_owned(),
        ];
        if let Some(shown) = &misprint.demonstration {
            let values = [shown.printed, shown.correct, shown.truth];
            cells.push(shown.what.to_owned());
            // What is zero but for rounding is zero.
            let clean = |value: f64| if value.abs() < 1e-12 { 0.0 } else { value };
            cells.extend(values.map(|value| significant(clean(value), 5)));
        }
        cells
    };
    let header = [
        "place",
        "printed",
        "correct",
        "shown by",
        "printed form",
        "correct form",
        "what has to come out",
    ];
    Table::new("Misprints", &header, all.iter().map(row))
}
