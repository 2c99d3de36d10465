-- What mends a finding: a JSON array of edits, see roslens.model.edit.

ALTER TABLE finding ADD COLUMN edits TEXT NOT NULL DEFAULT '[]';

DROP VIEW findings;
CREATE VIEW findings AS
SELECT run_unit.run AS run, unit.package AS package, finding.rule, finding.severity, finding.message, finding.path,
       finding.line, finding."column", finding.end_line, finding.end_column, finding.entity, tag_set.tags AS tags,
       finding.tool, finding.fingerprint, finding.quantity, finding.value, finding.bound, finding.model, finding.gated,
       finding.witnesses, finding.others, finding.edits
FROM run_unit
JOIN unit ON unit.id = run_unit.unit
JOIN finding ON finding.unit = unit.id
JOIN tag_set ON tag_set.id = finding.tag_set;
