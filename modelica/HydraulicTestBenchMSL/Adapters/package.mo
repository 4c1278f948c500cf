within HydraulicTestBenchMSL;
package Adapters "Between the hydraulic ports of the two libraries"
  extends Modelica.Icons.InterfacesPackage;
  annotation(Documentation(info="<html>
<p>Volume flow and gauge pressure here, mass flow and absolute pressure in <code>Modelica.Fluid</code>.</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Adapters;
