//! An address to listen on: an IP address or a name, and a port.

use std::net::{SocketAddr, ToSocketAddrs};

/// Why an address cannot be listened on.
#[derive(Debug, thiserror::Error)]
pub(super) enum ListenError {
    /// No address, or a name that is not found.
    #[error("{0}; expected a name or an IP address, and a port, such as localhost:8080")]
    Address(#[from] std::io::Error),
    /// A name without addresses.
    #[error("the name has no address")]
    NoAddress,
}

/// An address to listen on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ListenAddress {
    pub(super) address: SocketAddr,
    /// The name that it was given by.
    pub(super) name: Option<String>,
}

impl ListenAddress {
    /// Resolves an address such as `127.0.0.1:8080`, `[::1]:8080` or `localhost:8080`. Of the addresses of a name it is the first of
    /// IPv4, if there is one: clients ask 127.0.0.1 by default.
    pub(super) fn resolve(text: &str) -> Result<Self, ListenError> {
        if let Ok(address) = text.parse() {
            let name = None;
            return Ok(Self { address, name });
        }
        let addresses: Vec<SocketAddr> = text.to_socket_addrs()?.collect();
        let of_ipv4 = addresses.iter().find(|address| address.is_ipv4());
        let address = of_ipv4.or(addresses.first());
        let name = text.rsplit_once(':').map(|(name, _)| name.to_owned());
        match address {
            Some(&address) => Ok(Self { address, name }),
            None => Err(ListenError::NoAddress),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_and_names_are_resolved() {
        for (text, address, name) in [
            ("127.0.0.2:80", "127.0.0.2:80", None),
            ("[::1]:0", "[::1]:0", None),
            ("localhost:8080", "127.0.0.1:8080", Some("localhost")),
        ] {
            let listen = ListenAddress::resolve(text).expect("an address");
            assert_eq!(listen.address.to_string(), address);
            assert_eq!(listen.name.as_deref(), name);
        }
        for text in [
            "",
            "localhost",
            "localhost:http",
            "localhost:99999",
            "8080",
            "::1",
        ] {
            let error = ListenAddress::resolve(text).expect_err("no address");
            assert!(
                error.to_string().contains("such as localhost:8080"),
                "{text}: {error}"
            );
        }
    }
}
