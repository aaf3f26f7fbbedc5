//! `fretwear probe`: checks whether a service on this machine is ready, for health checks without another HTTP client.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::time::Duration;

use crate::cli::runtime::block_on;
use crate::cli::terminal::{Ended, failed, write_out};
use crate::client::Client;

/// Time limit of the request.
const TIMEOUT: Duration = Duration::from_secs(4);

pub(super) fn run(listen: SocketAddr, is_tls: bool) -> Ended {
    let address = local(listen);
    let scheme = if is_tls { "https" } else { "http" };
    let url = format!("{scheme}://{address}");
    let client = if is_tls {
        Client::unverified(&url)
    } else {
        Client::new(&url, None, None)
    };
    let client = client.map_err(failed)?;
    block_on(client.check_ready(TIMEOUT))?.map_err(failed)?;
    write_out(format_args!("ready: {url}"))
}

/// Returns the address at which a local service with this listen address is reached.
fn local(listen: SocketAddr) -> SocketAddr {
    let ip = match listen.ip() {
        IpAddr::V4(ip) if ip.is_unspecified() => IpAddr::V4(Ipv4Addr::LOCALHOST),
        IpAddr::V6(ip) if ip.is_unspecified() => IpAddr::V6(Ipv6Addr::LOCALHOST),
        ip => ip,
    };
    SocketAddr::new(ip, listen.port())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_service_on_all_addresses_is_probed_on_loopback() {
        for (listen, expected) in [
            ("0.0.0.0:80", "127.0.0.1:80"),
            ("[::]:80", "[::1]:80"),
            ("127.0.0.2:8080", "127.0.0.2:8080"),
        ] {
            let listen: SocketAddr = listen.parse().expect("an address");
            assert_eq!(local(listen).to_string(), expected);
        }
    }
}
