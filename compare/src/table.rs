//! What comes out: a table of Markdown for people, JSON for programs.
use std::fmt::Write;

use serde_json::{Value, json};

use crate::experiment::{Cell, Column};

/// A row: an engine at some settings.
pub struct Row {
    pub dim: usize,
    pub engine: &'static str,
    pub settings: &'static str,
    pub cells: Vec<Cell>,
}

/// One experiment.
pub struct Table {
    pub name: &'static str,
    pub title: &'static str,
    pub what: &'static str,
    pub columns: &'static [Column],
    pub rows: Vec<Row>,
}

impl Table {
    /// As Markdown.
    pub fn markdown(&self) -> String {
        let mut text = format!("## {}\n\n{}\n\n", self.title, self.what);
        let heads: String = self.columns.iter().map(|c| format!(" {} |", c.0)).collect();
        let exact: String = self.columns.iter().map(|c| format!(" {} |", c.1)).collect();
        let _ = writeln!(text, "| engine | settings |{heads}\n|---|---|{}", "---|".repeat(self.columns.len()));
        let _ = writeln!(text, "| *exact* | |{exact}");
        for row in &self.rows {
            let bold = if row.engine == "Carom" { "**" } else { "" };
            let name = if row.engine == "Carom" { format!("Carom, {}D", row.dim) } else { row.engine.to_string() };
            let cells: String = row.cells.iter().map(|c| format!(" {} |", c.shown)).collect();
            let _ = writeln!(text, "| {bold}{name}{bold} | {} |{cells}", row.settings);
        }
        text
    }

    /// As JSON.
    pub fn json(&self) -> Value {
        let row = |row: &Row| {
            let cells: Vec<Value> = self
                .columns
                .iter()
                .zip(&row.cells)
                .map(|(c, cell)| json!({ "column": c.0, "exact": c.1, "shown": cell.shown, "numbers": cell.numbers }))
                .collect();
            json!({ "dim": row.dim, "engine": row.engine, "settings": row.settings, "cells": cells })
        };
        json!({ "name": self.name, "title": self.title, "what": self.what, "rows": self.rows.iter().map(row).collect::<Vec<_>>() })
    }
}
