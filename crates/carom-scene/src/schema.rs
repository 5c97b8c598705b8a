//! The JSON Schema of a scene (draft 2020-12), printed from the table of keys.
use serde_json::{Map, Value, json};

use crate::keys::{Key, Kind, Rule, SCENE, Shape};

/// The JSON Schema of a scene file: for editors, and for programs that write scenes.
pub fn schema() -> Value {
    let mut root = object(&SCENE);
    root["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    root["title"] = json!("Carom scene, version 1");
    root
}

fn object(shape: &Shape) -> Value {
    let properties: Map<String, Value> = shape.keys.iter().map(|key| (key.name.to_owned(), property(key))).collect();
    let required: Vec<&str> = shape.keys.iter().filter(|k| k.required).map(|k| k.name).collect();
    let mut schema = json!({
        "type": "object",
        "description": shape.about,
        "properties": properties,
        "additionalProperties": false,
    });
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    schema
}

fn property(key: &Key) -> Value {
    let mut schema = match key.kind {
        Kind::Number(rule) => number(rule),
        Kind::Coefficient(rule) => {
            let speed = number(Rule::NotNegative);
            let point = json!({ "type": "array", "prefixItems": [speed, number(rule)], "minItems": 2, "maxItems": 2 });
            let curve = json!({
                "type": "object",
                "properties": { "curve": {
                    "type": "array",
                    "description": "Points [speed in m/s, value] of rising speed; linear between them, constant outside.",
                    "items": point,
                    "minItems": 1,
                } },
                "required": ["curve"],
                "additionalProperties": false,
            });
            json!({ "oneOf": [number(rule), curve] })
        }
        Kind::Integer { least, most } => json!({ "type": "integer", "minimum": least, "maximum": most }),
        Kind::Text => json!({ "type": "string" }),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Choice(names) => json!({ "enum": names }),
        Kind::Vector => json!({ "type": "array", "items": { "type": "number" }, "minItems": 1, "maxItems": 3 }),
        Kind::Spin => json!({ "type": "array", "items": { "type": "number" }, "maxItems": 3 }),
        Kind::Axes => json!({ "type": "array", "items": { "enum": crate::fields::AXES }, "uniqueItems": true }),
        Kind::TwoNames => json!({ "type": "array", "items": { "type": "string" }, "minItems": 2, "maxItems": 2 }),
        Kind::Table(shape) => object(shape),
        Kind::List(shape) => json!({ "type": "array", "items": object(shape) }),
        Kind::Named(shape) => json!({ "type": "object", "additionalProperties": object(shape) }),
        Kind::Sweep => sweep(),
    };
    schema["description"] = json!(key.about);
    schema
}

fn number(rule: Rule) -> Value {
    match rule {
        Rule::Finite => json!({ "type": "number" }),
        Rule::Positive => json!({ "type": "number", "exclusiveMinimum": 0 }),
        Rule::NotNegative => json!({ "type": "number", "minimum": 0 }),
        Rule::Within(low, high) => json!({ "type": "number", "minimum": low, "maximum": high }),
    }
}

fn sweep() -> Value {
    json!({
        "type": "object",
        "additionalProperties": { "anyOf": [
            { "type": "array", "minItems": 1 },
            {
                "type": "object",
                "properties": {
                    "range": {
                        "type": "array",
                        "description": "First and last; without steps every integer from first to last.",
                        "items": { "type": "number" },
                        "minItems": 2,
                        "maxItems": 2,
                    },
                    "steps": { "type": "integer", "description": "How many numbers, at equal steps.", "minimum": 2 },
                },
                "required": ["range"],
                "additionalProperties": false,
            },
        ] },
    })
}
