//! Which cases someone means.
use std::sync::atomic::{AtomicUsize, Ordering};

use thiserror::Error;

use crate::case::{Case, Topic};
use crate::{Book, Row};

/// A case and the file it stands in.
#[derive(Clone, Copy, Debug)]
pub struct Chosen<'b> {
    /// The file.
    pub topic: &'b Topic,
    /// The case.
    pub case: &'b Case,
}

impl Chosen<'_> {
    /// "topic/case".
    pub fn name(&self) -> String {
        format!("{}/{}", self.topic.name, self.case.name)
    }

    /// Runs it: a row for each number.
    pub fn run(&self) -> Vec<Row> {
        self.case.run(self.topic)
    }
}

/// Nothing in the book has this name.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("nothing in the book is called `{name}`\nhelp: {}`--list` has all names", offer(.nearest))]
pub struct Unknown {
    /// The name.
    pub name: String,
    /// The nearest that there are, the best first; none, if no name is like it.
    pub nearest: Vec<String>,
}

fn offer(nearest: &[String]) -> String {
    match nearest {
        [] => String::new(),
        [one] => format!("did you mean `{one}`? "),
        all => format!("did you mean one of {}? ", all.join(", ")),
    }
}

/// How many names an error offers.
const OFFERED: usize = 4;

impl Book {
    /// All cases, in order.
    pub fn cases(&self) -> impl Iterator<Item = Chosen<'_>> {
        self.topics.iter().flat_map(|topic| topic.cases.iter().map(move |case| Chosen { topic, case }))
    }

    /// The cases that a name means: all of them (`None`), those of a file, one case (with its file or without), or else all whose names begin so.
    /// Cases that take long are among them if `long` says so, or if one is named in full.
    ///
    /// # Errors
    /// [`Unknown`], with the nearest names.
    pub fn choose(&self, name: Option<&str>, long: bool) -> Result<Vec<Chosen<'_>>, Unknown> {
        let quick = |chosen: &Chosen<'_>| long || !chosen.case.long;
        let Some(name) = name else { return Ok(self.cases().filter(quick).collect()) };
        // A row's name is its case's, up to the colon.
        let name = name.split(": ").next().unwrap_or(name).trim();
        let exact: Vec<Chosen<'_>> = self.cases().filter(|c| c.name() == name || c.case.name == name).collect();
        if !exact.is_empty() {
            return Ok(exact);
        }
        let file: Vec<Chosen<'_>> = self.cases().filter(|c| c.topic.name == name).filter(quick).collect();
        if !file.is_empty() {
            return Ok(file);
        }
        let begins = |c: &Chosen<'_>| c.name().starts_with(name) || c.case.name.starts_with(name);
        let found: Vec<Chosen<'_>> = self.cases().filter(begins).filter(quick).collect();
        if !name.is_empty() && !found.is_empty() {
            return Ok(found);
        }
        Err(self.unknown(name))
    }

    /// Names that hold the word come first, then those that differ by a typing error.
    fn unknown(&self, name: &str) -> Unknown {
        let mut all: Vec<String> = self.topics.iter().map(|t| t.name.clone()).collect();
        all.extend(self.cases().map(|c| c.name()));
        let word = name.to_lowercase();
        let mut nearest: Vec<String> =
            all.iter().filter(|n| !word.is_empty() && n.contains(&word)).take(OFFERED).cloned().collect();
        let own = |n: &str| n.rsplit_once('/').map_or(n.to_owned(), |(_, case)| case.to_owned());
        while nearest.len() < OFFERED {
            let left: Vec<&String> = all.iter().filter(|n| !nearest.contains(n)).collect();
            let whole = carom_scene::nearest(name, left.iter().map(|n| n.as_str()));
            let short: Vec<String> = left.iter().map(|n| own(n)).collect();
            let part = carom_scene::nearest(name, short.iter().map(String::as_str));
            let best = match (whole, part) {
                (Some((whole, true)), _) => Some(whole.to_owned()),
                (_, Some((part, true))) => left.iter().find(|n| own(n) == part).map(|n| (*n).clone()),
                _ => None,
            };
            match best {
                Some(best) => nearest.push(best),
                None => break,
            }
        }
        Unknown { name: name.to_owned(), nearest }
    }
}

/// Runs these cases on as many threads as the machine has: the rows of each, in the order of the cases.
pub fn run(cases: &[Chosen<'_>]) -> Vec<Vec<Row>> {
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get()).min(cases.len().max(1));
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            let Some(case) = cases.get(k) else { return done };
            done.push((k, case.run()));
        }
    };
    let mut all: Vec<(usize, Vec<Row>)> = std::thread::scope(|scope| {
        let workers: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
        let mut all = work();
        for worker in workers {
            match worker.join() {
                Ok(done) => all.extend(done),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        all
    });
    all.sort_by_key(|(k, _)| *k);
    all.into_iter().map(|(_, rows)| rows).collect()
}
