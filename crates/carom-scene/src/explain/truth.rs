//! No line of the chain says something else than the numbers: every equation is evaluated, every page looked over.
use super::text::width;
use super::*;
use proptest::prelude::*;

/// Every equation of a chain.
fn rows(chain: &Chain) -> Vec<&Row> {
    let items = chain.opening.iter().chain(chain.steps.iter().flat_map(|s| &s.items));
    items
        .flat_map(|item| match item {
            Item::Equations(rows) => rows.iter().collect(),
            Item::Checks(checks) => checks.iter().map(|c| &c.2).collect(),
            _ => Vec::new(),
        })
        .collect()
}

/// The largest difference between two sides of an equation that have values.
fn untruth(row: &Row) -> f64 {
    let values: Vec<Value> = row.sides.iter().filter_map(|s| Values::default().evaluate(&s.formula)).collect();
    let differ = |pair: &[Value]| {
        let (a, b) = (pair[0].numbers(), pair[1].numbers());
        // An angle is given in rad and in degrees.
        if row.sides.iter().any(|s| s.unit == Unit::Degree) {
            return 0.0;
        }
        // The zero vector may be written 0.
        let zeros = vec![0.0; a.len()];
        let b = if b == [0.0] { &zeros } else { b };
        a.iter().zip(b).fold(f64::from(u8::from(a.len() != b.len())), |most, (a, b)| most.max((a - b).abs()))
    };
    values.windows(2).map(differ).fold(0.0, f64::max)
}

fn one(dim: usize) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-10.0..10.0f64, dim)
}

fn question() -> impl Strategy<Value = Question> {
    let mass = || prop_oneof![9 => 0.5..20.0f64, 1 => Just(f64::INFINITY)];
    let e = prop_oneof![Just(0.0), Just(1.0), 0.0..1.0f64];
    (1..=3usize).prop_flat_map(move |dim| {
        (mass(), 0.5..20.0f64, one(dim), one(dim), one(dim), e.clone(), prop::bool::ANY, prop::bool::ANY).prop_map(
            |(m1, m2, v1, v2, normal, e, swap, timed)| {
                let masses = if swap { [m2, m1] } else { [m1, m2] };
                let question = Question::new(masses, [v1, v2]).normal(normal).restitution(e);
                if timed { question.duration(0.01) } else { question }
            },
        )
    })
}

/// The same with friction, spins and every law; a wall's spin too.
fn rough() -> impl Strategy<Value = Question> {
    let end = |low: f64, high: f64| prop_oneof![Just(low), Just(high), low..high];
    let spin = || one(3);
    let radius = || 0.5..5.0f64;
    let law = (0..3usize).prop_map(|k| carom::Law::ALL[k]);
    (question(), end(0.0, 2.0), end(-1.0, 1.0), [radius(), radius()], [spin(), spin()], law, prop::bool::ANY).prop_map(
        |(question, mu, e_t, radius, spin, law, turning)| {
            let spins = [0, 1, 3][question.dim() - 1];
            let question = Question { law, ..question.friction(mu, radius).tangential(e_t) };
            if turning { question.spin(spin.map(|s| s[..spins].to_vec())) } else { question }
        },
    )
}

proptest! {
    #[test]
    fn every_equation_is_true(question in prop_oneof![question(), rough()]) {
        prop_assume!(question.normal.iter().flatten().any(|n| n.abs() > 1e-3));
        let explanation = question.answer().unwrap();
        prop_assert!(explanation.checks.iter().all(|c| c.holds), "{:?}", explanation.checks);
        let chain = explanation.chain(Language::English);
        for row in rows(&chain) {
            // Values up to 4e4 (energies) and forces a hundred times an impulse: a few roundings of 1e-11 at most; 1e-8 is
            // far below any slip in a formula.
            prop_assert!(untruth(row) < 1e-8, "{} {:?}", untruth(row), row);
        }
    }

    #[test]
    fn every_page_is_clean(question in prop_oneof![question(), rough()]) {
        prop_assume!(question.normal.iter().flatten().any(|n| n.abs() > 1e-3));
        let explanation = question.answer().unwrap();
        for language in Language::ALL {
            let chain = explanation.chain(language);
            let text = chain.text(false);
            for line in text.lines() {
                prop_assert!(width(line) <= 100, "{line}");
            }
            let (markdown, latex) = (chain.markdown(), chain.latex());
            for page in [&text, &markdown, &latex] {
                for wrong in ["NaN", "?,", "\u{a0}", "\x1b", "−0 ", "−0)", "-0 ", "  \n"] {
                    prop_assert!(!page.contains(wrong), "{wrong:?} in\n{page}");
                }
            }
            prop_assert!(!text.contains('{') && !markdown.contains('{'), "a place was not filled in\n{text}");
            prop_assert!(!chain.latex().contains(['−', '₁', '′', '·', '×', '≈', '≤', '½', 'θ', 'μ', 'ω', 'Ω', 'σ', 'ₜ']));
        }
        prop_assert!(!explanation.json().contains("-0.0,") && !explanation.json().contains("-0.0]"));
    }
}

#[test]
fn examples_fit_eighty_columns() {
    let plane = Question::new([2.0, 3.0], [vec![5.0, 0.0], vec![-1.0, 2.0]]).normal([3.0, 4.0]).restitution(0.5);
    let space =
        Question::new([5.0, 1.0], [vec![1.0; 3], vec![-2.0, 0.0, 1.0]]).normal([1.0, 2.0, 2.0]).restitution(1.0 / 3.0);
    let line = Question::new([2.0, 1.0], [vec![3.0], vec![-1.0]]).restitution(0.5);
    let odd = Question::new([1.0, f64::INFINITY], [vec![1.0, 1.0], vec![0.3, 0.7]]).normal([1.0, 1.0]).duration(0.003);
    let grips = plane.clone().friction(3.0, [0.1, 0.2]).tangential(0.25).spin([vec![10.0], vec![0.0]]);
    let slides = space.clone().friction(0.1, [0.1, 0.2]).spin([vec![1.0, 0.0, 2.0], vec![0.0; 3]]);
    for question in [line, plane, space, odd, grips, slides] {
        for language in Language::ALL {
            let text = question.answer().unwrap().chain(language).text(false);
            for line in text.lines() {
                assert!(width(line) <= 80, "{line}");
            }
        }
    }
}

#[test]
fn colour_changes_nothing_but_colour() {
    let chain = Question::new([2.0, 1.0], [vec![3.0], vec![-1.0]]).answer().unwrap().chain(Language::English);
    let (plain, coloured) = (chain.text(false), chain.text(true));
    assert!(coloured.contains("\x1b[1m") && !plain.contains('\x1b'));
    let mut bare = String::new();
    for (k, piece) in coloured.split('\x1b').enumerate() {
        bare += if k == 0 { piece } else { piece.split_once('m').unwrap().1 };
    }
    let trimmed: Vec<&str> = bare.lines().map(str::trim_end).collect();
    assert_eq!(trimmed, plain.lines().collect::<Vec<_>>());
}

#[test]
fn all_eleven_steps_are_told() {
    for dim in 1..=3 {
        let (mut v, mut n) = (vec![0.0; dim], vec![0.0; dim]);
        (v[0], n[0]) = (1.0, 1.0);
        for masses in [[1.0, 2.0], [f64::INFINITY, 2.0], [1.0, f64::INFINITY]] {
            for v in [v.clone(), v.iter().map(|v| -v).collect()] {
                let question = Question::new(masses, [v, vec![0.0; dim]]).normal(n.clone());
                let chain = question.answer().unwrap().chain(Language::Portuguese);
                let numbers: Vec<u8> = chain.steps.iter().filter_map(|s| s.number).collect();
                assert_eq!(numbers, (1..=11).collect::<Vec<_>>());
                assert!(chain.steps.iter().all(|s| !s.items.is_empty()));
            }
        }
    }
}
