within HydraulicTestBench;
package Types "Physical quantities with SI and display units"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>Own types, so that the library loads alone. Quantity, unit and sign agree with <code>Modelica.Units.SI</code>, so
that
its connectors can be joined to those of the Modelica Standard Library. <code>nominal</code> is the size a solver should
expect, <code>displayUnit</code> the one a hydraulics engineer reads.</p>
<p><b>Source:</b> thesis, nomenclature and Tables 4.5, 4.6 and 5 for the display units.</p>
</html>"));
end Types;
