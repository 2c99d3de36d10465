-- What follows from a finding and how certain that is; empty where its tool declares none, and in older runs.

ALTER TABLE finding ADD COLUMN consequence TEXT NOT NULL DEFAULT '';
ALTER TABLE finding ADD COLUMN certainty TEXT NOT NULL DEFAULT '';

DROP VIEW findings;
CREATE VIEW findings AS
SELECT run_unit.run AS run, unit.package AS package, finding.rule, finding.severity, finding.message, finding.path,
       finding.line, finding."column", finding.end_line, finding.end_column, finding.entity, tag_set.tags AS tags,
       finding.tool, finding.fingerprint, finding.quantity, finding.value, finding.bound, finding.model, finding.gated,
       finding.witnesses, finding.others, finding.edits, finding.consequence, finding.certainty
FROM run_unit
JOIN unit ON unit.id = run_unit.unit
JOIN finding ON finding.unit = unit.id
JOIN tag_set ON tag_set.id = finding.tag_set;
