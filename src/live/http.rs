//! Requests in, answers out, on one connection each; every wait has an end.

use super::gate::{Head, Refusal};
use std::{
    io::{self, Read, Write},
    net::{Shutdown, TcpStream},
    time::{Duration, Instant},
};

/// Most bytes of a head.
const MOST_HEAD: usize = 16 << 10;
/// Most headers.
const HEADERS: usize = 64;
/// A request comes whole within this time; what is written is taken within it.
pub const PATIENCE: Duration = Duration::from_secs(5);

/// The request that begins on a connection: its head, and what came of its body with it.
///
/// # Errors
/// It is none, or too long, or too late.
pub fn head(stream: &mut TcpStream) -> Result<(Head, Vec<u8>), Refusal> {
    const BAD: Refusal = (400, "Bad Request");
    let end = Instant::now() + PATIENCE;
    let (mut bytes, mut chunk) = (Vec::new(), [0_u8; 4096]);
    loop {
        let n = read(stream, &mut chunk, end).map_err(|_| (408, "Request Timeout"))?;
        if n == 0 {
            return Err(BAD);
        }
        bytes.extend_from_slice(&chunk[..n]);
        let mut headers = [httparse::EMPTY_HEADER; HEADERS];
        let mut request = httparse::Request::new(&mut headers);
        match request.parse(&bytes) {
            Ok(httparse::Status::Complete(length)) => {
                let head = Head {
                    method: request.method.unwrap_or_default().into(),
                    target: request.path.unwrap_or_default().into(),
                    headers: request
                        .headers
                        .iter()
                        .map(|h| {
                            let value = String::from_utf8_lossy(h.value).into_owned();
                            (h.name.to_ascii_lowercase(), value)
                        })
                        .collect(),
                };
                return Ok((head, bytes.split_off(length)));
            }
            Ok(httparse::Status::Partial) if bytes.len() < MOST_HEAD => {}
            Ok(httparse::Status::Partial) => return Err((431, "Request Header Fields Too Large")),
            Err(_) => return Err(BAD),
        }
    }
}

/// The body of a request, `length` bytes of it.
///
/// # Errors
/// It does not come.
pub fn body(stream: &mut TcpStream, mut begun: Vec<u8>, length: usize) -> Result<Vec<u8>, Refusal> {
    let end = Instant::now() + PATIENCE;
    let mut chunk = [0_u8; 16 << 10];
    while begun.len() < length {
        match read(stream, &mut chunk, end) {
            Ok(n) if n > 0 => begun.extend_from_slice(&chunk[..n]),
            _ => return Err((408, "Request Timeout")),
        }
    }
    begun.truncate(length);
    Ok(begun)
}

fn read(stream: &mut TcpStream, into: &mut [u8], end: Instant) -> io::Result<usize> {
    let left = end.saturating_duration_since(Instant::now());
    if left.is_zero() {
        return Err(io::ErrorKind::TimedOut.into());
    }
    stream.set_read_timeout(Some(left))?;
    stream.read(into)
}

/// What every answer says: nobody keeps it, frames it, guesses its kind or hears of its address.
const ALWAYS: &str = "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n\
Cross-Origin-Resource-Policy: same-origin\r\nX-Frame-Options: DENY\r\nConnection: close\r\n";

/// The beginning of an answer that goes on.
///
/// # Errors
/// Nobody takes it.
pub fn begin(stream: &mut TcpStream, kind: &str) -> io::Result<()> {
    stream.set_write_timeout(Some(PATIENCE))?;
    write!(stream, "HTTP/1.1 200 OK\r\nContent-Type: {kind}\r\n{ALWAYS}\r\n")
}

/// A whole answer.
///
/// # Errors
/// Nobody takes it.
pub fn answer(stream: &mut TcpStream, status: Refusal, kind: &str, body: &str) -> io::Result<()> {
    stream.set_write_timeout(Some(PATIENCE))?;
    let (code, reason) = status;
    let length = body.len();
    let head = format!(
        "HTTP/1.1 {code} {reason}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n{ALWAYS}\r\n"
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(body.as_bytes())
}

/// Whether whoever listens has gone: nothing more is to come from there but the end.
///
/// # Errors
/// The connection is broken.
pub fn is_gone(stream: &mut TcpStream) -> io::Result<bool> {
    stream.set_nonblocking(true)?;
    let read = stream.read(&mut [0_u8; 64]);
    stream.set_nonblocking(false)?;
    match read {
        Ok(n) => Ok(n == 0),
        Err(e) if e.kind() == io::ErrorKind::WouldBlock => Ok(false),
        Err(e) => Err(e),
    }
}

/// A refusal. Of what was still to come a little is taken, so that the word arrives before the end
/// of the connection does; no more than that.
pub fn refuse(stream: &mut TcpStream, refusal: Refusal) {
    const LITTLE: usize = 8;
    let _ = answer(stream, refusal, "text/plain; charset=utf-8", refusal.1);
    let _ = stream.shutdown(Shutdown::Write);
    let _ = stream.set_read_timeout(Some(Duration::from_millis(20)));
    let mut chunk = [0_u8; 16 << 10];
    for _ in 0..LITTLE {
        if !matches!(stream.read(&mut chunk), Ok(n) if n > 0) {
            break;
        }
    }
}
