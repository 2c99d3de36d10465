-- A unit without a key that names a package holds what only all packages of one run together show of that package, as
-- what is found in computation graphs: it stands right behind the package's own unit, and is no package of its own.

DROP VIEW packages;
CREATE VIEW packages AS
SELECT run_unit.run AS run,
       unit.package AS id,
       json_extract(unit.summary, '$.name') AS name,
       json_extract(unit.summary, '$.path') AS path,
       coalesce(json_extract(unit.summary, '$.version'), '') AS version,
       coalesce(json_extract(unit.summary, '$.build_type'), '') AS build_type,
       coalesce(json_extract(unit.summary, '$.dependencies'), '[]') AS dependencies
FROM run_unit JOIN unit ON unit.id = run_unit.unit
WHERE unit.package <> '' AND unit.key IS NOT NULL;
