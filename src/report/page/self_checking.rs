//! A page that verifies its own answer: it holds the result and the checker, as WebAssembly.

use super::html;
use data_encoding::BASE64;
use serde_json::Value;

/// The bridge to the module, and what is done with it.
pub(super) const SCRIPTS: &[&str] =
    &[include_str!("assets/module.js"), include_str!("assets/checking.js")];
/// Where it is said.
pub(super) const PLACE: &str = include_str!("assets/verified.html");

/// What a page verifies itself by.
#[derive(Clone, Debug)]
pub struct SelfChecking {
    /// The checker, a module of WebAssembly that gzip has compressed (`web/build` makes it).
    pub module: Vec<u8>,
    /// The result, as it is saved.
    pub result: Value,
}

impl SelfChecking {
    pub(super) fn html(&self) -> Result<String, serde_json::Error> {
        let result = html::escaped(&serde_json::to_string(&self.result)?);
        Ok(format!(
            "<script type=\"application/json\" id=\"result\">{result}</script>\n<script type=\"application/gzip\" id=\"checker\">{}</script>\n",
            BASE64.encode(&self.module)
        ))
    }
}
