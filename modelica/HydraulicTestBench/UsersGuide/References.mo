within HydraulicTestBench.UsersGuide;
class References "Literature"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<ul>
<li>S. S. T&oslash;rdal and A. Klausen: <i>System Identification of a Variable Piston Pump and Design of a Hydraulic
Load
Circuit</i>. Master's thesis, University of Agder, Grimstad, 2015. Called the thesis.</li>
<li>Bosch Rexroth: axial piston variable pump A4VSG, control HS4 and proportional valve 4WRE 6 (data sheets the thesis
takes
Tables 1, 2 and 5 from).</li>
<li>H. E. Merritt: <i>Hydraulic Control Systems</i>. Wiley, 1967 (orifice, chamber and valve equations).</li>
<li>Modelica Association: <i>Modelica Language Specification</i> 3.6, 2023; <i>Functional Mock-up Interface</i> 2.0 and
3.0.</li>
</ul>
<p><b>Source:</b> the works themselves.</p>
</html>"));
end References;
