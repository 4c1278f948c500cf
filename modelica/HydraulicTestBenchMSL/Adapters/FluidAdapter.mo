within HydraulicTestBenchMSL.Adapters;
model FluidAdapter "Hydraulic port of this library to a fluid port of Modelica.Fluid"
  replaceable package Medium = Modelica.Media.Incompressible.Examples.Essotherm650
    constrainedby Modelica.Media.Interfaces.PartialMedium "Medium on the side of Modelica.Fluid"
    annotation(choicesAllMatching=true);
  parameter Modelica.Units.SI.Density rho = 875 "Density by which volume becomes mass";
  parameter Modelica.Units.SI.AbsolutePressure p_ambient = 101325 "Absolute pressure of the surrounding air";
  HydraulicTestBench.Interfaces.Port_a port "Gauge pressure and volume flow"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Modelica.Fluid.Interfaces.FluidPort_b fluidPort(redeclare package Medium = Medium)
    "Absolute pressure and mass flow"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
equation
  fluidPort.p = port.p + p_ambient;
  fluidPort.m_flow = -rho*port.q;
  fluidPort.h_outflow = Medium.h_default;
  fluidPort.Xi_outflow = Medium.X_default[1:Medium.nXi];
  fluidPort.C_outflow = zeros(Medium.nC);
  annotation(Documentation(info="<html>
<p>p = p<sub>gauge</sub> + p<sub>ambient</sub>, m = &rho;q. Oil that leaves towards <code>Modelica.Fluid</code> has the
medium's default enthalpy. The default medium is a thermal oil of 884 kg/m<sup>3</sup> at 40 degrees Celsius.</p>
<p><b>Source:</b> connectors of both libraries.</p>
<p><b>Valid:</b> liquids. The density is one number, so that no oil is lost between a side that counts volume and one
that counts mass; choose that of the medium at its mean pressure.</p>
<p><b>Leaves out:</b> heat: temperature does not pass.</p>
</html>"));
end FluidAdapter;
