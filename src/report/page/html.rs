//! Text inside HTML.

use base::plain::document;
use serde_json::Value;

/// JSON as it may stand in a `script` element of type `application/json`: nothing in it ends the
/// element or opens a comment.
///
/// # Errors
/// Only if memory runs out.
pub(super) fn json(value: &Value) -> Result<String, serde_json::Error> {
    Ok(escaped(&serde_json::to_string(&shown(value))?))
}

/// The text of a JSON value so that nothing in it ends an element.
pub(super) fn escaped(json: &str) -> String {
    // Outside strings JSON has none of these characters.
    json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// The value with every text as it is to be read: scripts put it on the page as it is.
fn shown(value: &Value) -> Value {
    match value {
        Value::String(text) => document(text).into(),
        Value::Array(list) => list.iter().map(shown).collect(),
        Value::Object(members) => {
            members.iter().map(|(key, value)| (document(key).into_owned(), shown(value))).collect()
        }
        other => other.clone(),
    }
}

/// The template with every `{{name}}` replaced, in one pass: what is put in is not looked at again.
pub(super) fn fill(template: &str, values: &[(&str, &str)]) -> String {
    let mut out =
        String::with_capacity(template.len() + values.iter().map(|v| v.1.len()).sum::<usize>());
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        out.push_str(before);
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        if let Some((_, value)) = values.iter().find(|v| v.0 == name) {
            out.push_str(value);
        }
        rest = after;
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::plain::markup;

    const HOSTILE: &str = "</script><img src=x onerror='alert(1)'>&\"<!--";

    #[test]
    fn nothing_ends_the_element_it_stands_in() {
        for text in [markup(HOSTILE), json(&Value::from(HOSTILE)).unwrap()] {
            assert!(!text.contains(['<', '>']) && !text.contains("&\""), "{text}");
        }
        assert_eq!(
            serde_json::from_str::<String>(&json(&Value::from(HOSTILE)).unwrap()).unwrap(),
            HOSTILE
        );
    }

    #[test]
    fn what_is_put_in_is_not_a_template() {
        assert_eq!(fill("a {{x}} {{y}} {{none}}!", &[("x", "{{y}}"), ("y", "2")]), "a {{y}} 2 !");
    }
}
