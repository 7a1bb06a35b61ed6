//! A page that follows a scene file while it is worked on: `voussoir open`.
//!
//! One thread watches the file (`follow`), one asks (`worker`), one per connection answers a
//! browser (`server`); they meet at the `Desk`, which holds what is wanted and what
//! was found last. Every answer comes from [`ask`](crate::analysis::ask()).
//!
//! The server is a few routes over `std::net` with `httparse` for the heads of requests. That crate
//! is maintained, has no dependencies and is what hyper itself reads HTTP/1 with. A server such as
//! tiny_http (last release 2022) reads the rest of every body that was announced before it lets a
//! connection go, so that a refused request of 100 MB would still be received; here nothing is read
//! before it is known to be wanted, and every wait has an end.

mod desk;
mod error;
mod follow;
mod gate;
mod http;
mod knobs;
mod reply;
mod server;
mod thread;
mod worker;

use crate::import::Reach;
use std::{io, net::SocketAddr, path::Path, sync::Arc};
use thread::thread;

/// A page about a scene file that is ready to be served.
pub struct Live {
    server: server::Server,
    address: SocketAddr,
}

impl Live {
    /// Begins to follow a file; `port` 0 takes one that is free. Only this machine reaches it.
    ///
    /// # Errors
    /// The file is not there, the port is taken, or the system gives no random numbers or threads.
    pub fn open(scene: &Path, reach: Reach, port: u16) -> io::Result<Self> {
        let desk = Arc::new(desk::Desk::new());
        let server = server::Server::bind(port, scene, desk.clone())?;
        let address = server.address()?;
        let folder = scene.parent().unwrap_or(Path::new("")).to_path_buf();
        let place = scene.canonicalize()?;
        let file = follow::File { path: scene.to_path_buf(), place, folder, reach };
        let (watched, seen) = (file.clone(), desk.clone());
        thread("follow", move || follow::run(&watched, &seen))?;
        thread("ask", move || worker::run(&file, &desk))?;
        Ok(Self { server, address })
    }

    /// Where the page is, with the token that opens it.
    pub fn url(&self) -> String {
        format!("http://{}/{}/", self.address, self.server.token())
    }

    /// Answers browsers as long as the process lasts.
    pub fn serve(&self) {
        self.server.run();
    }
}
