//! What an impact means: the chain of `carom explain`, from the question that an engine poses about it.
#![allow(unsafe_code)]
use carom_scene::explain::{Explanation, Language, Symbols};

use crate::desk::with;
use crate::posed::Posed;

fn explained(numbers: &[f64], names: &str) -> Option<Explanation> {
    let posed = Posed::unpack(numbers, names)?;
    Explanation::of_impulse(&posed.question, posed.impulse, &posed.friction_impulse).ok().flatten()
}

/// Room for `count` numbers for the next verb.
#[unsafe(no_mangle)]
pub extern "C" fn numbers_in(count: u32) -> *mut f64 {
    with(|desk| {
        desk.numbers.clear();
        desk.numbers.resize(count as usize, 0.0);
        desk.numbers.as_mut_ptr()
    })
}

/// Leaves the chain of an impact, `null` where it is none of the lecture's. The numbers are those of its question; the input is a
/// line that names the language and the letters ("pt-BR Q,I"), then the names of the question.
#[unsafe(no_mangle)]
pub extern "C" fn words_explain() {
    with(|desk| {
        let (how, names) = desk.text().split_once('\n').unwrap_or_default();
        let (language, letters) = how.split_once(' ').unwrap_or((how, ""));
        let language: Language = language.parse().unwrap_or_default();
        let chain = explained(&desk.numbers, names).map(|x| x.page(language, Symbols::named(letters)));
        desk.output = chain.unwrap_or_else(|| "null".into());
    });
}
