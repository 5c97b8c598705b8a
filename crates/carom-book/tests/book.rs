//! The whole book, run as `carom verify` runs it, and what a book has to be.
use carom_book::{Book, Row};
use std::collections::BTreeSet;

fn book() -> Book {
    Book::open().unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn the_engine_comes_to_what_the_book_says() {
    let book = book();
    let mut failed: Vec<Row> = Vec::new();
    let mut numbers = 0;
    let quick = book.choose(None, false).unwrap();
    for topic in quick.chunk_by(|a, b| a.topic.name == b.topic.name) {
        let rows: Vec<Row> = carom_book::run(topic).into_iter().flatten().collect();
        for row in &rows {
            println!(
                "{} {:<70} expected {:<22} got {:<22} error {:9.1e} of {:.1e}",
                if row.pass { "ok  " } else { "FAIL" },
                row.name,
                row.expected,
                row.got,
                row.error,
                row.tolerance
            );
        }
        numbers += rows.len();
        failed.extend(rows.into_iter().filter(|row| !row.pass));
    }
    println!("{numbers} numbers");
    let told = |row: &Row| format!("{}: {:?} {} {}", row.name, row.trouble, row.expected, row.got);
    assert!(failed.is_empty(), "{:#?}", failed.iter().map(told).collect::<Vec<_>>());
}

#[test]
fn every_case_has_its_own_name_a_reference_and_a_reason_for_its_tolerance() {
    let book = book();
    let mut names = BTreeSet::new();
    for chosen in book.cases() {
        let (name, case) = (chosen.name(), chosen.case);
        assert!(names.insert(name.clone()), "{name} stands twice in the book");
        let word = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '.';
        assert!(case.name.chars().all(word), "{name}: names are in small letters");
        assert!(case.reference.trim().len() > 8, "{name} has no reference");
        assert!(case.because.trim().len() > 4, "{name} does not say where its tolerance comes from");
        assert!(!case.check.is_empty(), "{name} checks nothing");
        for text in [&case.reference, &case.because] {
            assert!(!text.trim_end().ends_with('.'), "{name}: the table sets its own full stops");
        }
    }
    assert!(names.len() >= 120, "{} cases", names.len());
    for topic in &book.topics {
        assert!(!topic.title.is_empty() && topic.about.len() > 40, "{}", topic.name);
        assert!(!names.contains(&topic.name));
    }
}

/// What is expected is never read from the engine: an expected number is a number, or a formula of the case's own names.
#[test]
fn nothing_that_is_expected_is_measured() {
    for chosen in book().cases() {
        let names = carom_book::case::Names::of(chosen.case);
        for check in &chosen.case.check {
            for number in [Some(&check.expected), check.tolerance.as_ref(), Some(&chosen.case.tolerance)] {
                let value = number.map(|n| names.value(n)).transpose();
                assert!(value.is_ok(), "{}: {value:?}", chosen.name());
            }
        }
    }
}

/// A tolerance that no error can exceed would make a case that cannot fail.
#[test]
fn every_number_of_a_quick_case_could_fail() {
    let statistical = ["hard-discs", "hard-spheres", "gas-statistics", "determinism"];
    for chosen in book().cases().filter(|c| !statistical.contains(&c.topic.name.as_str()) && !c.case.long) {
        for row in chosen.run() {
            // What is compared to 0 has no scale of its own; what is not, must not be as wide as itself.
            let wide = row.expected != 0.0 && row.tolerance >= 0.25 * row.expected.abs();
            assert!(!wide, "{}: {} of {}", row.name, row.tolerance, row.expected);
        }
    }
}

#[test]
fn names_choose() {
    let book = book();
    let count = |name: &str| book.choose(Some(name), false).map(|c| c.len());
    assert_eq!(count("galperin/k-3"), Ok(1));
    assert_eq!(count("k-3"), Ok(1));
    assert_eq!(count("galperin/any-ratio: impacts"), Ok(1));
    assert!(count("galperin").is_ok_and(|n| n > 5));
    assert!(count("cradle-").is_ok_and(|n| n > 5));
    // In full a case is found that takes long; among others it is left out.
    let long = book.choose(Some("galperin"), true).map(|c| c.len());
    assert!(count("k-6") == Ok(1) && long == count("galperin").map(|n| n + 1));
    let unknown = book.choose(Some("galprin"), false).unwrap_err();
    assert_eq!(unknown.nearest[0], "galperin");
    let unknown = book.choose(Some("superbal-under-a-table"), false).unwrap_err();
    assert_eq!(unknown.nearest[0], "friction-and-spin/superball-under-a-table");
    println!("{unknown}");
    let unknown = book.choose(Some("xyzzy"), false).unwrap_err();
    assert!(unknown.nearest.is_empty() && unknown.to_string().contains("--list"), "{unknown}");
    assert!(book.choose(Some(""), false).is_err() && book.choose(Some("xyzzy"), false).is_err());
}

/// What stands wrongly in a case is said, and fails: nothing is passed over.
#[test]
fn a_case_that_cannot_be_read_fails() {
    let case = |rest: &str| {
        let text = format!(
            "title = \"t\"\nabout = \"a\"\n[[case]]\nname = \"c\"\nreference = \"r\"\ntolerance = 1\nbecause = \"b\"\n{rest}"
        );
        let book = Book::read([("own", text.as_str())])?;
        let row = book.cases().next().map(|c| c.run().remove(0)).expect("one case");
        assert!(!row.pass && row.got.is_nan(), "{rest}: {row:?}");
        Ok::<String, carom_book::formula::Misread>(row.trouble.unwrap_or_default())
    };
    let said = [
        ("scene = \"two-balls\"\ncheck = [[\"vx[Z]\", 1]]", "no body is called `Z`"),
        ("scene = \"two-balls\"\ncheck = [[\"time[Z\", 1]]", "a `]` is missing"),
        ("scene = \"two-bals\"\ncheck = [[\"time\", 1]]", "no scene is called `two-bals`"),
        ("scene = \"two-balls\"\ncheck = [[\"impulse[9]\", 1]]", "there is no impact 9"),
        ("scene = \"two-balls\"\ncheck = [[\"time\", \"x\"]]", "nothing is called `x`"),
        ("scene = \"two-balls\"\nset = { \"body.A.mass\" = -1 }\ncheck = [[\"time\", 1]]", "mass must be positive"),
        ("check = [[\"time\", 1]]", "one of scene, contact, several, meeting"),
    ];
    for (rest, want) in said {
        let got = case(rest).unwrap_or_else(|e| panic!("{e}"));
        assert!(got.contains(want), "{got}");
    }
    assert!(Book::read([("own", "title = 1")]).unwrap_err().to_string().starts_with("book/own.toml"));
    assert!(case("chek = 1\ncheck = [[\"time\", 1]]").unwrap_err().to_string().contains("chek"));
}

/// The table in the guide has the cases of the book as they are now, and their references; its numbers are of the day it was made.
#[test]
fn the_guide_has_every_case() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../guide");
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let (page, chapter) = (read("book-cases.md"), read("book.md"));
    let remedy = "carom verify --format markdown > guide/book-cases.md";
    let book = book();
    let mut numbers = 0;
    for chosen in book.cases().filter(|c| !c.case.long) {
        let line = format!("- **{}**: {}.", chosen.case.name, chosen.case.reference);
        assert!(page.contains(&line), "{}: {remedy}", chosen.name());
        numbers += chosen.case.check.len();
    }
    assert_eq!(page.matches(" | ✓ |\n").count(), numbers, "{remedy}");
    for topic in &book.topics {
        assert!(page.contains(&format!("## {}\n", topic.title)), "{}: {remedy}", topic.name);
        assert!(chapter.contains(&format!("`{}`", topic.name)), "the guide does not say what {} holds", topic.name);
    }
}

/// The case that the guide shows is one.
#[test]
fn the_guide_s_own_case_passes() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../guide/book.md");
    let guide = std::fs::read_to_string(path).unwrap();
    let text = guide.split("```toml\n").nth(1).and_then(|rest| rest.split("```\n").next()).unwrap();
    let book = Book::read([("mine", text)]).unwrap();
    let rows: Vec<Row> = book.cases().flat_map(|c| c.run()).collect();
    assert!(rows.len() == 2 && rows.iter().all(|row| row.pass), "{rows:#?}");
}
