within ;
package HydraulicTestBenchMSL "The hydraulic test bench joined to the Modelica Standard Library"
  extends Modelica.Icons.Package;
  annotation(
    version="0.1.0",
    uses(Modelica(version="4.0.0"), HydraulicTestBench(version="0.1.0")),
    Documentation(info="<html>
<p>Signals, shafts and masses of the two libraries are joined by a plain <code>connect</code>: the connectors have the
same variables. <code>Examples</code> shows it. <code>Adapters</code> joins the hydraulic ports, which the standard
library has in <code>Modelica.Fluid</code> with mass flow and absolute pressure.</p>
<p>Needs the Modelica Standard Library 4.0.0. <code>fmu-build</code> compiles the examples too where that is given to
it,
but for the one with <code>Modelica.Fluid</code>, whose media it refuses.</p>
<p><b>Source:</b> Modelica Standard Library 4.0.0.</p>
</html>"));
end HydraulicTestBenchMSL;
