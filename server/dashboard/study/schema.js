// What the JSON Schema of a system says of each value of a specification.

/** Fields whose value decides which other fields of the same object apply. */
const TAGS = ["kind", "law", "dimension"];

/** What may stand at a place of a specification. */
export class Shape {
  #root;
  #schema;

  /**
   * @param {any} root the whole schema
   * @param {any} schema that of this place
   */
  constructor(root, schema = root) {
    this.#root = root;
    /** Whether `null` is a value. */
    this.nullable = [schema.type].flat().includes("null");
    /** @type {string} */
    this.description = schema.description ?? "";
    /** Forms that the value has a choice of, such as a name or an object. @type {Shape[]} */
    this.forms = [];
    let found = schema;
    while (found.$ref || found.oneOf) {
      if (found.$ref) found = root.$defs[found.$ref.split("/").pop()];
      else {
        const forms = found.oneOf.filter((/** @type {any} */ form) => form.type !== "null");
        this.nullable ||= forms.length < found.oneOf.length;
        if (forms.length > 1) {
          this.forms = forms.map((/** @type {any} */ form) => new Shape(root, form));
          break;
        }
        found = forms[0];
      }
      this.description ||= found.description ?? "";
    }
    this.#schema = found;
  }

  /** The values of an enumeration. @returns {string[] | null} */
  get choices() {
    return this.#schema.enum ?? null;
  }

  /** The only value that is possible, which is not edited; undefined where there are more. @returns {any} */
  get only() {
    return this.#schema.const;
  }

  /** Whether only one value is possible. */
  get is_fixed() {
    return this.only !== undefined;
  }

  /** @param {string} type of JSON @returns {boolean} */
  is(type) {
    return [this.#schema.type].flat().includes(type) || this.forms.some((form) => form.is(type));
  }

  /** The fields of an object, those of a map with known names included. @returns {Record<string, Shape> | null} */
  get fields() {
    const { properties, propertyNames, additionalProperties } = this.#schema;
    const all = properties ?? (propertyNames?.enum && Object.fromEntries(propertyNames.enum.map((/** @type {string} */ name) => [name, additionalProperties])));
    return all ? Object.fromEntries(Object.entries(all).map(([name, schema]) => [name, new Shape(this.#root, schema)])) : null;
  }

  /** What a list is of. @returns {Shape | null} */
  get items() {
    return this.#schema.items ? new Shape(this.#root, this.#schema.items) : null;
  }

  /** Whether it is a list of objects, each of which is edited by its fields. */
  get is_list_of_objects() {
    return Boolean(this.items?.fields);
  }

  /** @returns {string[]} names of fields that an object must have */
  get required() {
    return this.#schema.required ?? [];
  }

  /** The field that decides which others apply. @returns {string | null} */
  get tag() {
    const { fields } = this;
    return (fields && TAGS.find((name) => fields[name]?.choices)) ?? null;
  }

  /**
   * Whether a field applies to an object of a tag: descriptions start with the tags that a field is of, as in "`force`: the width".
   * @param {string} name
   * @param {string | undefined} tag
   */
  applies(name, tag) {
    const { fields } = this;
    const known = (this.tag && fields?.[this.tag].choices) ?? [];
    const said = fields?.[name].description ?? "";
    if (!tag || known.length === 0) return true;
    if (said.includes(`not of \`${tag}\``)) return false;
    const lists = said.match(/(?:`\w+`(?: \([^)]*\))?(?:, |(?=:)))+:/g) ?? [];
    const of = lists.flatMap((list) => list.match(/\w+(?=`)/g) ?? []).filter((other) => known.includes(other));
    return of.length === 0 || of.includes(tag);
  }

  /**
   * Whether an object of a tag must have a field.
   * @param {string} name
   */
  requires(name) {
    return this.required.includes(name) || Boolean(this.tag && this.fields?.[name].description.includes("Required there."));
  }

  /** Fields that this one stands instead of. @returns {string[]} */
  get instead_of() {
    const said = /(?:instead of|; or) ((?:`\w+`(?:,?\s(?:and|or)\s)?)+)/.exec(this.description)?.[1] ?? "";
    return said.match(/\w+(?=`)/g) ?? [];
  }

  /**
   * Fields that an object does not have beside one.
   * @param {string} name
   * @returns {string[]}
   */
  excluded_by(name) {
    const fields = Object.entries(this.fields ?? {});
    return fields.filter(([other, field]) => other !== name && (field.instead_of.includes(name) || this.fields?.[name]?.instead_of.includes(other))).map(([other]) => other);
  }

  /** A value to start with; undefined where no number is as good as another. @returns {any} */
  get initial() {
    if (this.is("number") || this.is("string")) return this.choices?.[0];
    if (this.is("boolean")) return true;
    if (this.is("integer")) return this.#schema.minimum;
    if (this.items) return this.items.fields ? [this.items.initial] : [];
    const { fields, tag } = this;
    const needed = Object.keys(fields ?? {}).filter((name) => name === tag || (this.required.includes(name) && fields?.[name].initial !== undefined));
    return Object.fromEntries(needed.map((name) => [name, fields?.[name].initial]));
  }

  /**
   * What may stand at a JSON pointer below this place, in each of its forms.
   * @param {string} pointer
   * @returns {Shape[]}
   */
  at(pointer) {
    const key = (/** @type {string} */ step) => step.replaceAll("~1", "/").replaceAll("~0", "~");
    /** @type {(shape: Shape) => Shape[]} */
    const forms_of = (shape) => (shape.forms.length ? shape.forms.flatMap(forms_of) : [shape]);
    const below = (/** @type {Shape} */ shape, /** @type {string} */ name) => shape.fields?.[name] ?? (/^\d+$/.test(name) ? shape.items : null);
    return pointer.split("/").slice(1).map(key).reduce((/** @type {Shape[]} */ found, name) =>
      found.flatMap((shape) => below(shape, name) ?? []).flatMap(forms_of), forms_of(this));
  }
}
