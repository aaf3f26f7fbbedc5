//! `GET /problems/{name}`: the page that explains a type of problem, at the address that the `type` of a problem document has.

use std::fmt::Write as _;

use api::problem::Problem;
use axum::response::IntoResponse;

use crate::http::extract::Name;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::routes::operation::serve_pages::{HTML, headers};

/// `Content-Security-Policy` of the page: it loads its style sheet only.
const CONTENT_POLICY: &str = "default-src 'none'; style-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Error of an unknown type.
#[derive(Debug, thiserror::Error)]
#[error("there is no such type of problem; /problems/internal links to all")]
struct NoTypeError;

impl RouteError for NoTypeError {
    const TYPE: ProblemType = ProblemType::NO_SUCH_PATH;
}

/// Meaning of a type of problem, and its remedy.
#[utoipa::path(
    get,
    path = "/problems/{name}",
    tag = "pages",
    params(("name" = String, Path, description = "Last part of the type")),
    responses(
        (status = 200, description = "The page", content_type = "text/html", body = String),
        (status = 404, description = "No such type", body = Problem),
    )
)]
pub(crate) async fn explain(Name(name): Name) -> Result<impl IntoResponse, ProblemResponse> {
    let found = ProblemType::ALL.iter().find(|known| known.name == name);
    let page = page(found.ok_or(NoTypeError)?)?;
    Ok((headers(HTML, CONTENT_POLICY), page))
}

fn page(problem: &ProblemType) -> Result<String, std::fmt::Error> {
    let ProblemType {
        status,
        name,
        title,
        explanation,
    } = problem;
    let mut page = String::new();
    write!(
        page,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>fretwear: {title}</title>\n\
         <link rel=\"stylesheet\" href=\"/assets/style.css\">\n</head>\n<body>\n\
         <header><h1>fretwear</h1><a href=\"/\">jobs</a><a href=\"/docs\">interface</a></header>\n\
         <h2>{title}</h2>\n<p class=\"mono muted\">/problems/{name}, status {status}</p>\n<p>{}</p>\n\
         <h3>All types</h3>\n<ul>\n",
        as_html(explanation)
    )?;
    for ProblemType { name, title, .. } in ProblemType::ALL {
        writeln!(
            page,
            "<li><a href=\"/problems/{name}\">{name}</a>: {title}</li>"
        )?;
    }
    page.push_str("</ul>\n</body>\n</html>\n");
    Ok(page)
}

/// Text with code between backticks as HTML.
fn as_html(text: &str) -> String {
    let escaped = text.replace('&', "&amp;").replace('<', "&lt;");
    let parts = escaped.split('`').enumerate();
    parts
        .map(|(index, part)| match index % 2 {
            0 => part.to_owned(),
            _ => format!("<code>{part}</code>"),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::http::tests::Service;

    #[tokio::test]
    async fn the_type_of_every_problem_is_a_page() {
        let service = Service::new().await;
        for problem in ProblemType::ALL {
            let path = format!("/problems/{}", problem.name);
            let (status, headers, page) = service.text("GET", &path, &[], "").await;
            assert_eq!(
                (status.as_u16(), &headers["content-type"]),
                (200, &"text/html; charset=utf-8".parse().expect("a value"))
            );
            assert!(
                page.contains(problem.title)
                    && page.matches("<code>").count() == page.matches("</code>").count()
            );
            assert!(problem.explanation.len() > 40, "{}", problem.name);
        }
        let (status, _, problem) = service.get("/problems/none").await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (404, Some("/problems/no-such-path"))
        );
        // As a client follows it.
        let (_, _, problem) = service.get("/v1/jobs?stauts=queued").await;
        let path = problem["type"].as_str().expect("a type");
        assert_eq!(service.text("GET", path, &[], "").await.0, 200);
    }

    #[test]
    fn names_are_unique_and_code_is_marked() {
        let mut names: Vec<_> = ProblemType::ALL
            .iter()
            .map(|problem| problem.name)
            .collect();
        names.sort_unstable();
        let all = names.len();
        names.dedup();
        assert_eq!(names.len(), all);
        assert_eq!(as_html("a `b<c` d"), "a <code>b&lt;c</code> d");
    }
}
