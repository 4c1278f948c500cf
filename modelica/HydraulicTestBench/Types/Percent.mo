within HydraulicTestBench.Types;
type Percent = Real(
    final quantity="Percent", final unit="%",
    nominal=10) "Share of full deflection in percent"
  annotation(Documentation(info="<html>
<p>The bench commands and logs the swash plate angle in percent of 15 degrees.</p>
<p>The symbol % is FMI's and everyday's; Modelica's own units are made of letters (Modelica Language Specification 3.6,
Section 19.1), and a strict tool may say so and check the units of an equation with it no further. The unit 1 would be
wrong: a value of 50 stands for 50 percent, and a tool that reads unit 1 with display unit % shows 5000 % for it.</p>
<p><b>Source:</b> thesis, nomenclature; the numbers inside a model are SI units.</p>
</html>"));
