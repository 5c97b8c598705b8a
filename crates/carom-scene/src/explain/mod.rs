//! One impact, explained: the lecture's chain from p = m v to the projection form, with the numbers put in.
//!
//! [`Question`] is what is asked, [`Explanation`] holds every quantity of the impact, [`Chain`] is the telling of it: steps of
//! prose, equations and tables in a language, which [`Chain::text`], [`Chain::markdown`] and [`Chain::latex`] set on paper.
//! The command line and the browser lab show the very same chain.
//!
//! ```
//! use carom_scene::explain::{Language, Question};
//! let question = Question::new([2.0, 1.0], [vec![3.0], vec![-1.0]]).restitution(0.5);
//! let explanation = question.answer().unwrap();
//! assert_eq!(explanation.impulse, 4.0);
//! assert!(explanation.chain(Language::English).text(false).contains("v₁′"));
//! ```
mod brief;
mod chain;
mod check;
mod contact;
mod formula;
mod friction;
mod impact;
mod json;
mod latex;
mod letter;
mod markdown;
mod meaning;
mod number;
mod opening;
mod origin;
mod page;
mod pen;
mod question;
mod result;
mod rub;
mod special;
mod steps;
mod teller;
mod text;
#[cfg(test)]
mod truth;
mod values;
mod words;

pub use chain::{Chain, Choice, Inline, Item, Matrices, Piece, Row, Side, Step, Table};
pub use check::{Balance, Check};
pub use contact::slips;
pub use formula::Formula;
pub use friction::Friction;
pub use impact::{Explanation, Rotated, State};
pub use letter::Letter;
pub use number::Unit;
pub use origin::{Origin, Origins, Source};
pub use page::{ImpulseLetter, Symbols};
pub use question::{Mistake, Question};
pub use special::Special;
pub use values::{Value, Values};
pub use words::Language;
