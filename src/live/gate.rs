//! Who is let in: a browser on this machine that knows the token, on a page of our own.
//!
//! The address is that of the loopback alone. Another page in the same browser may still try: it is
//! told apart by `Origin` and `Sec-Fetch-Site`, and a name that somebody points at this machine (DNS
//! rebinding) by `Host`. Without the token of 128 random bits there is nothing at all here.

use std::{io, net::SocketAddr};

/// Most bytes of a body. Edits of a page are some thousand.
const MOST_BODY: usize = 1 << 20;

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Route {
    /// The page.
    Page,
    /// What is said, as it is said.
    Events,
    /// A question.
    Ask,
    /// The scene as changed is to be written beside the file.
    Save,
}

/// Why nothing is given: status and reason.
pub type Refusal = (u16, &'static str);

/// The head of a request, as far as it matters.
#[derive(Debug, Default)]
pub struct Head {
    /// GET, POST, …
    pub method: String,
    /// The target.
    pub target: String,
    /// Names in small letters, values.
    pub headers: Vec<(String, String)>,
}

impl Head {
    /// The only value of a header: a header given twice is a contradiction.
    fn only(&self, name: &str) -> Result<Option<&str>, Refusal> {
        let mut all = self.headers.iter().filter(|h| h.0 == name).map(|h| h.1.as_str());
        match (all.next(), all.next()) {
            (_, Some(_)) => Err((400, "Bad Request")),
            (one, None) => Ok(one),
        }
    }
}

/// The gate of one server.
pub struct Gate {
    token: String,
    hosts: [String; 2],
}

impl Gate {
    /// A gate with a token of its own.
    ///
    /// # Errors
    /// The system gives no random numbers.
    pub fn new(address: SocketAddr) -> io::Result<Self> {
        let mut bytes = [0_u8; 16];
        getrandom::fill(&mut bytes).map_err(io::Error::other)?;
        let token = bytes.iter().map(|b| format!("{b:02x}")).collect();
        let port = address.port();
        Ok(Self { token, hosts: [format!("127.0.0.1:{port}"), format!("localhost:{port}")] })
    }

    /// The token.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// What a request asks for, and how long its body is.
    ///
    /// # Errors
    /// It is refused.
    pub fn check(&self, head: &Head) -> Result<(Route, usize), Refusal> {
        const FORBIDDEN: Refusal = (403, "Forbidden");
        const NOT_FOUND: Refusal = (404, "Not Found");
        let host = head.only("host")?.ok_or((400, "Bad Request"))?;
        if !self.hosts.iter().any(|h| h.eq_ignore_ascii_case(host)) {
            return Err(FORBIDDEN);
        }
        // Of the host that was named: another name of this machine is another origin.
        if let Some(origin) = head.only("origin")?
            && origin.strip_prefix("http://").is_none_or(|o| !o.eq_ignore_ascii_case(host))
        {
            return Err(FORBIDDEN);
        }
        if head.only("sec-fetch-site")?.is_some_and(|s| s != "same-origin" && s != "none") {
            return Err(FORBIDDEN);
        }
        if head.only("transfer-encoding")?.is_some() {
            return Err((411, "Length Required"));
        }
        let length = match head.only("content-length")? {
            None => 0,
            Some(n) if !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()) => {
                n.parse().unwrap_or(usize::MAX)
            }
            Some(_) => return Err((400, "Bad Request")),
        };
        if length > MOST_BODY {
            return Err((413, "Content Too Large"));
        }
        let (token, rest) =
            head.target.strip_prefix('/').and_then(|t| t.split_once('/')).ok_or(NOT_FOUND)?;
        if !same(token, &self.token) {
            return Err(NOT_FOUND);
        }
        let (route, method) = match rest {
            "" => (Route::Page, "GET"),
            "events" => (Route::Events, "GET"),
            "ask" => (Route::Ask, "POST"),
            "save" => (Route::Save, "POST"),
            _ => return Err(NOT_FOUND),
        };
        if head.method != method {
            return Err((405, "Method Not Allowed"));
        }
        // What a form of another page can send without being asked is not taken.
        if method == "POST" && head.only("content-type")? != Some("application/json") {
            return Err((415, "Unsupported Media Type"));
        }
        Ok((route, length))
    }
}

/// Whether two words are the same, in a time that does not tell where they differ.
fn same(a: &str, b: &str) -> bool {
    a.len() == b.len() && a.bytes().zip(b.bytes()).fold(0, |d, (a, b)| d | (a ^ b)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_ours_comes_in() {
        let gate = Gate::new(SocketAddr::from(([127, 0, 0, 1], 4000))).unwrap();
        assert_eq!(gate.token().len(), 32);
        let ask = |method: &str, rest: &str, more: &[(&str, &str)]| {
            let mut headers = vec![("host", "127.0.0.1:4000")];
            headers.retain(|h| more.iter().all(|m| m.0 != h.0));
            headers.extend(more.iter().filter(|m| !m.1.is_empty()));
            let headers = headers.iter().map(|h| (h.0.to_string(), h.1.to_string())).collect();
            let target = rest.replace("T", gate.token());
            gate.check(&Head { method: method.into(), target, headers }).map_err(|e| e.0)
        };
        assert_eq!(ask("GET", "/T/", &[]), Ok((Route::Page, 0)));
        assert_eq!(
            ask("GET", "/T/events", &[("sec-fetch-site", "same-origin")]),
            Ok((Route::Events, 0))
        );
        let json = ("content-type", "application/json");
        let own = ("origin", "http://127.0.0.1:4000");
        assert_eq!(
            ask("POST", "/T/ask", &[json, own, ("content-length", "7")]),
            Ok((Route::Ask, 7))
        );
        assert_eq!(ask("POST", "/T/ask", &[own]), Err(415));
        for (rest, status) in [
            ("/", 404),
            ("/T", 404),
            ("/T/../T/", 404),
            ("/T/etc/passwd", 404),
            ("/T//", 404),
            ("/T/ask", 405),
            ("/0T/", 404),
            ("//", 404),
            ("*", 404),
            ("/T/events?x", 404),
        ] {
            assert_eq!(ask("GET", rest, &[]), Err(status), "{rest}");
        }
        for (name, value, status) in [
            ("host", "evil.example:4000", 403),
            ("host", "127.0.0.1:4001", 403),
            ("host", "", 400),
            ("origin", "http://evil.example", 403),
            ("origin", "null", 403),
            ("origin", "https://127.0.0.1:4000", 403),
            ("origin", "http://localhost:4000", 403),
            ("sec-fetch-site", "cross-site", 403),
            ("sec-fetch-site", "same-site", 403),
            ("content-length", "104857600", 413),
            ("content-length", "99999999999999999999999", 413),
            ("content-length", "-1", 400),
            ("transfer-encoding", "chunked", 411),
        ] {
            assert_eq!(ask("GET", "/T/", &[(name, value)]), Err(status), "{name}: {value}");
        }
    }
}
