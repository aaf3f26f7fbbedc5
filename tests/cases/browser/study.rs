//! A new job from the form: refused with its faults at their fields, planned as one types, submitted, cloned and changed.

use tests::Browser;

use super::{fits_a_phone, is_sound, service_and_browser};

/// Types a value into a field in place of what it has.
pub(super) async fn type_into(browser: &Browser, pointer: &str, value: &str) {
    let id = format!("field{}", pointer.replace('/', "-"));
    let script = format!(
        "const field = document.getElementById('{id}'); field.value = '{value}'; field.dispatchEvent(new Event('change'))"
    );
    browser
        .wait_for(&format!("document.getElementById('{id}') !== null"))
        .await;
    browser
        .client
        .execute(&script, Vec::new())
        .await
        .expect("it can be typed into");
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_study_is_made_refused_mended_submitted_and_cloned() {
    let (_folder, _server, browser) = service_and_browser().await;
    browser.open("/#/study?system=cylinder_on_flat").await;
    browser
        .shows("[aria-label=Expected]", "processor time")
        .await;
    browser
        .wait_for("document.querySelector('.drawing svg') !== null")
        .await;
    type_into(&browser, "/accuracy/preset", "draft").await;
    type_into(&browser, "/cycles", "0").await;
    let marked = "document.getElementById('field-cycles').getAttribute('aria-invalid') === 'true'";
    browser.wait_for(marked).await;
    browser.shows(".faults", "/cycles").await;
    browser
        .wait_for("document.querySelector('button.primary').disabled")
        .await;
    // The expectation of the last valid specification is dimmed, and said to be outdated.
    let dimmed = "document.querySelectorAll('.outdated[aria-disabled]').length";
    browser.wait_for(&format!("{dimmed} === 2")).await;
    browser
        .shows("[aria-label='To scale']", "not of what is written now")
        .await;
    type_into(&browser, "/cycles", "25").await;
    browser.wait_for(&format!("{dimmed} === 0")).await;
    browser.wait_for("document.querySelector('.faults').innerText === '' && !document.querySelector('button.primary').disabled").await;
    let cycles = "JSON.parse(document.querySelector('textarea').value).cycles === 25";
    browser.wait_for(cycles).await;
    fits_a_phone(&browser, "study").await;
    // Refused requests are messages of the console.
    let refused = browser.complaints().await;
    assert!(
        refused.iter().all(|line| line.contains("/v1/plans")),
        "{refused:#?}"
    );
    browser.click("button.primary").await;
    browser.shows(".status", "succeeded").await;
    let done =
        "/cycles done\\s+25\\b/.test(document.querySelector('[aria-label=Result]')?.innerText)";
    browser.wait_for(done).await;
    let clone = browser.client.execute("[...document.querySelectorAll('.actions a')].find((link) => link.innerText.startsWith('Clone')).click()", Vec::new());
    clone.await.expect("it can be clicked");
    browser.shows("h1", "New study").await;
    browser.wait_for(cycles).await;
    // The clone is of what was sent: defaults stay defaults.
    browser
        .wait_for(&format!(
            "Object.keys({WRITTEN}).sort().join() === 'accuracy,cycles,name,system'"
        ))
        .await;
    browser
        .shows("[aria-label=Expected]", "processor time")
        .await;
    is_sound(&browser).await;
    browser.close().await;
}

/// The specification that the form has written.
pub(super) const WRITTEN: &str = "JSON.parse(document.querySelector('textarea').value)";

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn laws_materials_and_sections_are_chosen_and_each_fault_stands_at_its_field() {
    let (_folder, _server, browser) = service_and_browser().await;
    browser.open("/#/study?system=fuzz_button").await;
    browser
        .shows("[aria-label=Expected]", "processor time")
        .await;
    // Another law asks for its own constants: the closed section opens, and each missing one is marked, no other.
    browser
        .wait_for("!document.querySelector('[data-group=interface]').open")
        .await;
    type_into(&browser, "/interface/wear/slider/law", "quinn").await;
    browser
        .wait_for("document.querySelector('[data-group=interface]').open")
        .await;
    let invalid = "[...document.querySelectorAll('[aria-invalid]')].map((field) => field.id)";
    browser
        .wait_for(&format!("{invalid}.length === 6 && {invalid}.every((id) => id.startsWith('field-interface-wear-slider-'))"))
        .await;
    let beside = "document.getElementById('field-interface-wear-slider-critical_film_um-fault').innerText.includes('missing')";
    browser.wait_for(beside).await;
    // Edited as JSON, the fields follow.
    let json = "const text = document.querySelector('textarea'); text.value = '{\"system\": {\"kind\": \"fuzz_button\"}, \"cycles\": 30}'; text.dispatchEvent(new Event('input'))";
    let typed = browser.client.execute(json, Vec::new());
    typed.await.expect("it can be typed into");
    browser
        .wait_for("document.getElementById('field-cycles').value === '30' && document.querySelector('.faults').innerText === ''")
        .await;
    // A material of the library, and one of its properties changed.
    type_into(&browser, "/materials/slider", "silver").await;
    browser
        .wait_for(&format!("{WRITTEN}.materials.slider === 'silver'"))
        .await;
    browser
        .wait_for("document.getElementById('field-materials-slider-youngs_modulus_mpa').value === '83000'")
        .await;
    type_into(&browser, "/materials/slider/youngs_modulus_mpa", "80000").await;
    browser
        .wait_for(&format!("{WRITTEN}.materials.slider.youngs_modulus_mpa === 80000 && {WRITTEN}.materials.slider.name === 'silver'"))
        .await;
    // A changed friction leaves wear and plating to their defaults.
    type_into(&browser, "/interface/friction/coefficient", "0.4").await;
    browser
        .wait_for(&format!("{WRITTEN}.interface.friction.coefficient === 0.4 && {WRITTEN}.interface.wear === undefined"))
        .await;
    // A section is added with its fault, and removed again.
    browser.click("[aria-label='add stop']").await;
    browser
        .wait_for(
            "document.getElementById('field-stop-0-layer').getAttribute('aria-invalid') === 'true'",
        )
        .await;
    type_into(&browser, "/stop/0/layer", "2").await;
    browser
        .wait_for(&format!(
            "{WRITTEN}.stop[0].layer === 2 && document.querySelector('.faults').innerText === ''"
        ))
        .await;
    fits_a_phone(&browser, "study-fields").await;
    browser.click("[aria-label='remove: stop']").await;
    browser
        .wait_for(&format!("{WRITTEN}.stop === undefined"))
        .await;
    let refused = browser.complaints().await;
    assert!(
        refused.iter().all(|line| line.contains("/v1/plans")),
        "{refused:#?}"
    );
    is_sound(&browser).await;
    browser.close().await;
}
