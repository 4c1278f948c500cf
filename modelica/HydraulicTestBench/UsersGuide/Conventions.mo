within HydraulicTestBench.UsersGuide;
class Conventions "Units, names and documentation"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p>Inside, everything is in SI units; angles in radians. Percent is used for the command and the logged angle alone,
because bench and data sheets do. <code>displayUnit</code> holds what an engineer reads: bar, mm, mm2, cm3 or l, N/mm,
ms,
Hz, degrees.</p>
<p><b>Pressure is gauge</b>, 0 is the surrounding air. Laws in absolute pressure add 1.013 bar themselves.</p>
<p><b>Names.</b> Parameters carry the thesis' symbols (<code>A_p</code>, <code>m_eff</code>, <code>K_D</code>). The
variables of <code>Pump.SwashPlateControl</code> carry the names of the thesis' Appendix F (<code>xp_tt</code>,
<code>PD_Der</code>, <code>p1_t</code>): _t is a time derivative, _tt the second one.</p>
<p><b>Numbers.</b> A parameter nobody can guess has no default. Sets of numbers are records in <code>Data</code>, each
with
its table. Bounds (<code>min</code>, <code>max</code>) of identified parameters are those of Table 4.6.</p>
<p><b>Documentation.</b> The text of a class says what it is, its equation and source, where it is valid and what it
leaves
out.</p>
<p><b>Smoothness.</b> Laws are smooth or at least continuous, without events; where the thesis' equation has a corner
(Eq. 3.3 at u = 0), the corner stays.</p>
<p><b>Source:</b> thesis, nomenclature, Tables 4.5, 4.6, 5 to 10.</p>
</html>"));
end Conventions;
