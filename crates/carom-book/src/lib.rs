//! The verification book: what the engine must come to, case by case, and what it comes to.
//!
//! A case is data (`book/*.toml`): a situation, where its numbers come from (an equation, a paper, a textbook), what is
//! read, what that must be, how far off it may be and why just so far. The book knows nothing of how the engine works, and no expected number is the
//! engine's own.
//!
//! ```
//! let book = carom_book::Book::open()?;
//! let chosen = book.choose(Some("lecture"), false)?;
//! for row in carom_book::run(&chosen).into_iter().flatten() {
//!     assert!(row.pass, "{}: {} instead of {}", row.name, row.got, row.expected);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
pub mod case;
mod choose;
mod contact;
pub mod formula;
mod gas;
mod meeting;
mod row;
mod scene;
mod several;
mod shelf;
mod twin;

pub use choose::{Chosen, Unknown, run};
pub use row::Row;

use case::Topic;
use formula::Misread;

/// The whole book, read.
#[derive(Clone, Debug)]
pub struct Book {
    /// Its files, in order.
    pub topics: Vec<Topic>,
}

impl Book {
    /// Reads the book that is in the binary.
    ///
    /// # Errors
    /// A file that is no book; the tests see to it that there is none.
    pub fn open() -> Result<Self, Misread> {
        Self::read(shelf::FILES.iter().copied())
    }

    /// Reads a book of one's own: names of files, without their extension, and their texts.
    ///
    /// # Errors
    /// A text that is no file of a book, with line and column.
    pub fn read<'t>(files: impl IntoIterator<Item = (&'t str, &'t str)>) -> Result<Self, Misread> {
        let topics = files.into_iter().map(|(name, text)| Topic::read(name, text)).collect::<Result<_, _>>()?;
        Ok(Self { topics })
    }
}
